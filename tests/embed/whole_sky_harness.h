// SPDX-License-Identifier: Apache-2.0
// Whole skies of small pictures, by pileus.h.
// in: scenes, layers, places -> out: pictures, light at places.
// docs/whole-sky.md
#pragma once
#include <cmath>
#include <limits>

#include "tests/embed/clouds_harness.h"

namespace whole_sky_test {

using namespace clouds_test;

struct FreeSky {
    void operator()(pileus_sky* p) const { pileus_sky_free(p); }
};

/// A sky of small pictures.
struct Whole {
    std::unique_ptr<pileus_sky, FreeSky> sky;
    Outcome out;
    std::uint32_t width = 24, height = 14;

    explicit Whole(const std::string& text, const Overrides& more = {},
                   const pileus_host* host = nullptr) {
        const SceneHandle scene = scene_of(text, more);
        pileus_sky* made = nullptr;
        check(pileus_sky_create(scene.get(), host, &made, &out.error));
        sky.reset(made);
    }
    void check(pileus_code code) { REQUIRE_MESSAGE(code == PILEUS_OK, out.line()); }
    pileus_session* session() { return pileus_sky_session(sky.get()); }
    pileus_clouds* clouds() { return pileus_sky_clouds(sky.get()); }
    void aim(const double (&position)[3], const double (&target)[3], double fov_deg = 40) {
        const pileus_camera camera = camera_at(position, target, fov_deg, width, height);
        check(pileus_session_set_camera(session(), &camera, &out.error));
    }
    void sun(double azimuth_deg, double elevation_deg) {
        auto own = pileus_sun_default();
        own.azimuth_deg = azimuth_deg;
        own.elevation_deg = elevation_deg;
        check(pileus_session_set_sun(session(), &own, &out.error));
    }
    void add_layer(const std::string& text, const Overrides& more = {}) {
        const Hosted layer(text, more);
        REQUIRE_MESSAGE(layer.code == PILEUS_OK, layer.out.line());
        check(pileus_sky_add_layer(sky.get(), layer.world.get(), layer.scene.get(), &out.error));
    }
    void add_cumulus(const std::vector<pileus_cloud>& places, const Overrides& more = {}) {
        const Hosted kind(kSmallCumulus, add(kMarch, more));
        check(pileus_clouds_add_kind(clouds(), kind.world.get(), kind.scene.get(), nullptr,
                                     &out.error));
        place(places);
    }
    void place(const std::vector<pileus_cloud>& places) {
        check(
            pileus_clouds_place(clouds(), places.data(), std::uint32_t(places.size()), &out.error));
    }
    Picture draw(pileus_blend blend = PILEUS_BLEND_REPLACE, const float* depth = nullptr,
                 float fill = 0) {
        Picture p(width, height, fill);
        auto image = cleared<pileus_depth_image>();
        image.values = depth;
        const pileus_frame frame = p.frame(blend);
        check(
            pileus_sky_render(sky.get(), depth != nullptr ? &image : nullptr, &frame, &out.error));
        return p;
    }
    pileus_cloud_stats stats() {
        auto s = cleared<pileus_cloud_stats>();
        check(pileus_clouds_stats(clouds(), &s, &out.error));
        return s;
    }
    pileus_sky_light light_at(double x, double y, double z) {
        auto light = cleared<pileus_sky_light>();
        light.position_m[0] = x, light.position_m[1] = y, light.position_m[2] = z;
        check(pileus_sky_light_at(sky.get(), &light, 1, &out.error));
        return light;
    }
};

/// A wide deck of one colour between two heights, thick enough to hide all.
inline std::string deck(double low_m, double high_m, const std::string& albedo) {
    const auto number = [](double v) { return std::to_string(v); };
    std::string text = kSmallCumulus;
    const std::size_t from = text.find("[[medium]]"), to = text.find("[photon_grid]");
    text.replace(from, to - from,
                 "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-60000, -60000, " +
                     number(low_m) + "], [60000, 60000, " + number(high_m) +
                     "]]\nextinction_per_m = 0.1\nalbedo = " + albedo +
                     "\nphase = { type = \"isotropic\" }\n");
    return text;
}
constexpr const char* kRed = "[0.99, 0.2, 0.2]";
constexpr const char* kGreen = "[0.2, 0.99, 0.2]";

}  // namespace whole_sky_test
