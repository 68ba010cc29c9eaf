// SPDX-License-Identifier: Apache-2.0
// The sun's disc in a picture: its light adds up to the sun's irradiance, and what is before it
// hides it. in: cameras, suns -> out: pixels. docs/atmosphere.md, "In front of things"
#include "src/picture/sun_disc.h"

#include "src/world/camera/view.h"
#include "tests/support/air_scene.h"

using namespace render_test;
using air_test::in_air;

namespace {

struct Shot {
    CameraParams camera;
    std::vector<float> behind;

    Shot(int width, int height, double fov_deg) {
        Camera c;
        c.position_m = {0, 0, 0}, c.target_m = {0, 1000, 0};
        c.fov_deg = fov_deg, c.resolution = {width, height};
        camera = make_camera(c, 0, {});
        behind.assign(3 * std::size_t(width) * std::size_t(height), 0.0f);
    }
    /// Sum over pixels of radiance times cosine to the axis over the whole solid angle: by the
    /// image plane, whose element dx dy has the solid angle cos^3.
    double irradiance(int channel) const {
        const std::size_t pixels = behind.size() / 3;
        double sum = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
            const int x = int(i % std::size_t(camera.width)),
                      y = int(i / std::size_t(camera.width));
            const double px = (2 * (x + 0.5) / camera.width - 1) * double(camera.half_width);
            const double py = (1 - 2 * (y + 0.5) / camera.height) * double(camera.half_height);
            const double cosine = 1 / std::sqrt(1 + px * px + py * py);
            sum += double(behind[std::size_t(channel) * pixels + i]) * cosine * cosine * cosine;
        }
        return sum * 4 * double(camera.half_width) * double(camera.half_height) / double(pixels);
    }
};

SunDisc sun_at_deg(double azimuth_deg, double elevation_deg) {
    SunDisc disc;
    const Double3 to = towards_deg(azimuth_deg, elevation_deg);
    for (int a = 0; a < 3; ++a) disc.to_sun[a] = float(to[a]);
    disc.irradiance = {2, 1, 0.5};
    return disc;
}

}  // namespace

TEST_CASE(
    "sun disc: its light is the irradiance, in any picture, near the middle and near an edge") {
    for (const double fov_deg : {1.0, 40.0, 120.0})
        for (const int height : {9, 90, 720})
            for (const double share : {0.0, 0.4}) {
                CAPTURE(fov_deg);
                CAPTURE(height);
                CAPTURE(share);
                Shot shot(height * 16 / 9, height, fov_deg);
                // Pixels much larger than the disc have a cosine of their own; of others the disc
                // covers some 800 parts or more.
                const double pixel_deg = fov_deg / height;
                add_sun_disc(shot.camera, sun_at_deg(share * fov_deg, 0.1 * share * fov_deg), {},
                             {}, shot.behind.data());
                const double within = pixel_deg > 8 * kSunRadiusDeg ? 0.2 : 0.03;
                CHECK(shot.irradiance(0) == doctest::Approx(2).epsilon(within));
                CHECK(shot.irradiance(2) == doctest::Approx(0.5).epsilon(within));
            }
}

TEST_CASE("sun disc: hidden by the horizon, by solids, by media; not behind the camera") {
    const std::size_t pixels = 160 * 90;
    Shot half(160, 90, 4);
    SunDisc disc = sun_at_deg(0, 0);
    disc.horizon = 0;
    add_sun_disc(half.camera, disc, {}, {}, half.behind.data());
    CHECK(half.irradiance(1) == doctest::Approx(0.5).epsilon(0.03));
    disc.horizon = -1;
    const std::vector<float> solid(pixels, 5.0f), free(pixels, 1e30f), quarter(pixels, 0.25f);
    Shot none(160, 90, 4);
    add_sun_disc(none.camera, disc, {solid.data(), pixels}, {}, none.behind.data());
    for (const double azimuth_deg : {90.0, 180.0, 270.0})
        add_sun_disc(none.camera, sun_at_deg(azimuth_deg, 0), {}, {}, none.behind.data());
    add_sun_disc(none.camera, sun_at_deg(0, 90), {}, {}, none.behind.data());
    for (const float v : none.behind) REQUIRE(v == 0);
    Shot thin(160, 90, 4);
    add_sun_disc(thin.camera, disc, {free.data(), pixels}, {quarter.data(), pixels},
                 thin.behind.data());
    CHECK(thin.irradiance(1) == doctest::Approx(0.25).epsilon(0.03));
    // One pixel, and a sun far outside of the picture.
    Shot one(1, 1, 60);
    add_sun_disc(one.camera, sun_at_deg(0, 0), {}, {}, one.behind.data());
    CHECK(one.behind[0] > 0);
    Shot outside(16, 9, 10);
    add_sun_disc(outside.camera, sun_at_deg(60, 20), {}, {}, outside.behind.data());
    for (const float v : outside.behind) REQUIRE(v == 0);
}

TEST_CASE("sun disc: all methods show it in clear air, as bright as the air leaves it") {
    // Into the sun of the small cumulus' scene, past the cloud.
    const std::vector<std::string> look = {
        "camera.position_m=[0, -4000, 256]", "camera.target_m=[866.0254, -4500, 956.2075]",
        "camera.fov_deg=3", "camera.resolution=[24, 14]", "path.samples_per_pixel=1"};
    std::string with = in_air();
    float brightest = 0;
    for (const char* method : {"raymarch", "collectors", "photon-grid", "path"}) {
        CAPTURE(method);
        std::vector<std::string> set = look;
        set.push_back(std::string("method.name=") + method);
        const Picture seen = render_one(scene_from(with, set));
        set.push_back("atmosphere.sun_disc=false");
        const Picture without = render_one(scene_from(with, set));
        float most = 0;
        for (int y = 0; y < 14; ++y)
            for (int x = 0; x < 24; ++x) {
                CHECK(seen.at("R", x, y) >= without.at("R", x, y));
                most = std::max(most, seen.at("R", x, y) - without.at("R", x, y));
            }
        // Irradiance over the disc's solid angle, 6.8e-5 sr; of red the air leaves most.
        const double above = double(scene_from(with).sun.irradiance[0]) / 6.797e-5;
        CHECK(double(most) > 0.6 * above);
        CHECK(double(most) < 0.97 * above);
        if (brightest > 0) CHECK(most == brightest);
        brightest = most;
    }
}
