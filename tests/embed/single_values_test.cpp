// SPDX-License-Identifier: Apache-2.0
// Numbers that a host sets, at the ends of floats: refused, or a finite picture.
// in: each number of each struct of a session -> out: pass or fail.
// src/base/single.h; docs/scene.md, "Small numbers"
#include <cmath>
#include <functional>

#include "tests/embed/host_harness.h"

namespace single_values_test {

using namespace host_test;

constexpr double kNumbers[] = {4.9e-324, 1e-300, 1e-46,  1e-45,  1e-41,          1e-38,
                               1.2e-38,  1e-30,  1e-20,  1e-10,  3.4e38,         3.5e38,
                               1e39,     -1e-45, -1e-41, -1e-20, 179.9999999999, 359.9999999};

using Set = std::function<pileus_code(pileus_session*, double, pileus_error*)>;

pileus_camera camera_to_cloud() {
    auto camera = cleared<pileus_camera>();
    camera.width = camera.height = 8;
    camera.position_m[1] = -4000;
    camera.position_m[2] = 256;
    camera.target_m[2] = 1024;
    camera.fov_deg = 40;
    return camera;
}

/// A number of a camera, of a sun and so on, by how it is set.
std::vector<Set> all_sets() {
    std::vector<Set> sets;
    const auto camera = [&](std::function<void(pileus_camera&, double)> put) {
        sets.push_back([put](pileus_session* s, double v, pileus_error* e) {
            pileus_camera own = camera_to_cloud();
            put(own, v);
            return pileus_session_set_camera(s, &own, e);
        });
    };
    for (int a = 0; a < 3; ++a) {
        camera([a](pileus_camera& c, double v) { c.position_m[a] = v; });
        camera([a](pileus_camera& c, double v) { c.target_m[a] = v; });
        camera([a](pileus_camera& c, double v) { c.up[a] = v; });
        camera([a](pileus_camera& c, double v) {
            for (int i = 0; i < 3; ++i) c.target_m[i] = c.position_m[i];
            c.target_m[a] += v;
            c.up[(a + 1) % 3] = 1;
        });
    }
    camera([](pileus_camera& c, double v) { c.fov_deg = v; });
    camera([](pileus_camera& c, double v) { c.height_m = v; });
    camera([](pileus_camera& c, double v) { c.near_m = v; });
    sets.push_back([](pileus_session* s, double v, pileus_error* e) {
        const double view[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, -256, -4000, 1};
        const double projection[16] = {1 / v, 0, 0, 0, 0, 1 / v, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0};
        return pileus_session_set_matrices(s, view, projection, PILEUS_CLIP_ZERO, 8, 8, e);
    });
    const auto sun = [&](std::function<void(pileus_sun&, double)> put) {
        sets.push_back([put](pileus_session* s, double v, pileus_error* e) {
            auto own = cleared<pileus_sun>();
            own.present = 1;
            own.elevation_deg = 35;
            for (float& c : own.irradiance) c = 1;
            put(own, v);
            return pileus_session_set_sun(s, &own, e);
        });
    };
    sun([](pileus_sun& o, double v) { o.azimuth_deg = v; });
    sun([](pileus_sun& o, double v) { o.elevation_deg = v; });
    sun([](pileus_sun& o, double v) { o.irradiance[1] = float(v); });
    sets.push_back([](pileus_session* s, double v, pileus_error* e) {
        auto own = cleared<pileus_environment>();
        own.present = 1;
        own.radiance[0] = float(v);
        return pileus_session_set_environment(s, &own, e);
    });
    for (const bool albedo : {false, true})
        sets.push_back([albedo](pileus_session* s, double v, pileus_error* e) {
            auto own = cleared<pileus_ground>();
            own.present = 1;
            (albedo ? own.albedo : own.altitude_m) = v;
            return pileus_session_set_ground(s, &own, e);
        });
    const auto light = [&](std::uint32_t type, std::function<void(pileus_lamp&, double)> put) {
        sets.push_back([type, put](pileus_session* s, double v, pileus_error* e) {
            auto own = cleared<pileus_lamp>();
            own.type = type;
            own.position_m[2] = 1200;
            own.direction[2] = -1;
            own.cone_deg = 40;
            for (float& c : own.light) c = 1;
            put(own, v);
            return pileus_session_set_lamps(s, &own, 1, e);
        });
    };
    light(PILEUS_LAMP_POINT, [](pileus_lamp& o, double v) { o.position_m[0] = v; });
    light(PILEUS_LAMP_POINT, [](pileus_lamp& o, double v) { o.radius_m = v; });
    light(PILEUS_LAMP_POINT, [](pileus_lamp& o, double v) { o.light[2] = float(v); });
    light(PILEUS_LAMP_SPOT, [](pileus_lamp& o, double v) { o.cone_deg = v; });
    light(PILEUS_LAMP_SPOT, [](pileus_lamp& o, double v) { o.penumbra_deg = v; });
    light(PILEUS_LAMP_SPOT, [](pileus_lamp& o, double v) { o.direction[2] = v; });
    light(PILEUS_LAMP_SPOT, [](pileus_lamp& o, double v) { o.direction[0] = v; });
    light(PILEUS_LAMP_DIRECTIONAL, [](pileus_lamp& o, double v) { o.elevation_deg = v; });
    for (const bool yaw : {false, true})
        sets.push_back([yaw](pileus_session* s, double v, pileus_error* e) {
            auto own = cleared<pileus_placement>();
            (yaw ? own.yaw_deg : own.offset_m[2]) = v;
            return pileus_session_set_placement(s, &own, e);
        });
    return sets;
}

TEST_CASE("each number that a host sets is refused, or the picture is finite") {
    const std::string lamp = std::string(render_test::kSmallCumulus) +
                             "[[light]]\ntype = \"point\"\nposition_m = [0, 0, 1200]\n";
    int accepted = 0, refused = 0;
    Hosted host(
        lamp, {"method.name=\"raymarch\"", "camera.resolution=[8,8]", "medium.0.resolution=[8,8,6]",
               "raymarch.steps=16", "raymarch.sky_light=none"});
    host.check(host.code);
    const std::vector<Set> sets = all_sets();
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const Set& set = sets[i];
        CAPTURE(i);
        for (const double v : kNumbers) {
            CAPTURE(v);
            const pileus_code code = set(host.session.get(), v, &host.out.error);
            if (code != PILEUS_OK) {
                ++refused;
                CHECK(code == PILEUS_ERROR_INPUT);
                CHECK_MESSAGE(host.out.line().find("allowed: ") != std::string::npos,
                              host.out.line());
                continue;
            }
            ++accepted;
            std::vector<float> pixels(8 * 8 * 4);
            auto frame = cleared<pileus_frame>();
            frame.colour = pixels.data();
            frame.format = PILEUS_FORMAT_RGBA32F;
            host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
            for (const float p : pixels) REQUIRE(std::isfinite(p));
        }
        // What is set last is in nobody's way.
        host.check(set(host.session.get(), 1, &host.out.error));
    }
    CHECK(accepted > 200);
    CHECK(refused > 150);
}

TEST_CASE("what no float tells from 0 has the bits of 0") {
    Hosted host(render_test::kSmallCumulus, {"method.name=\"raymarch\""});
    host.sun(120, 35, 0);
    const std::string dark = host.hash();
    host.sun(120, 35, 1);
    CHECK(host.hash() != dark);
    host.sun(120, 35, 1e-41f);
    CHECK(host.hash() == dark);
}

}  // namespace single_values_test
