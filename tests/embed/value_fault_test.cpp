// SPDX-License-Identifier: Apache-2.0
// What sessions accept without a check of the whole scene, that check accepts, too.
// in: values at, within and beyond the ends of their ranges -> out: no fault where none was told.
// src/session/value_fault.h
#include "src/session/value_fault.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "src/scene/read_scene.h"

namespace pileus {
namespace {

Scene scene_of(const char* more) {
    Scene scene;
    const std::string text =
        "[camera]\nposition_m = [0, -3000, 600]\ntarget_m = [0, 0, 900]\n[sun]\n"
        "[sky]\nradiance = [1, 1, 1]\n[ground]\n[[medium]]\ndensity = \"uniform:sphere\"\n"
        "extinction_per_m = 0.01\nbounds_m = [[-100, -100, 800], [100, 100, 1000]]\n" +
        std::string(more);
    const Status status = read_scene_text(text, "scene", "", {}, scene);
    REQUIRE_MESSAGE(bool(status), status.message);
    return scene;
}

/// Draws numbers, many of them at the ends of ranges and no numbers at all.
class Draws {
public:
    double number(double low, double high) {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        const double special[] = {low,  high,       std::nextafter(low, -kInfinity),
                                  0,    -0.0,       std::nextafter(high, kInfinity),
                                  NAN,  kInfinity,  -kInfinity,
                                  1e-9, 2 * high,   low + (high - low) * 0.3,
                                  1,    high / 2.0, low + (high - low) * 1e-7};
        const std::uint32_t chosen = whole(60);
        if (chosen < sizeof special / sizeof special[0]) return special[chosen];
        return low + (high - low) * (double(whole(1u << 30)) / double(1u << 30));
    }
    std::uint32_t whole(std::uint32_t below) {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return std::uint32_t((state_ >> 33) % below);
    }
    template <class Vector>
    void fill(double low, double high, Vector& v) {
        for (int a = 0; a < 3; ++a)
            v[std::size_t(a)] = std::decay_t<decltype(v[0])>(number(low, high));
    }

private:
    std::uint64_t state_ = 1;
};

/// How many of `tries` were accepted; each of them is sound.
template <class Try>
int accepted(int tries, Try once) {
    int count = 0;
    for (int i = 0; i < tries; ++i) {
        Scene changed;
        if (once(changed) != nullptr) continue;
        ++count;
        changed.file = "session";
        const Status status = check_scene(changed);
        REQUIRE_MESSAGE(bool(status), status.message);
    }
    return count;
}

}  // namespace

TEST_CASE("values of cameras, suns, skies and grounds that are accepted at once are sound") {
    const Scene scene = scene_of("");
    Draws draws;
    const int cameras = accepted(4000, [&](Scene& changed) {
        changed = scene;
        Camera& c = changed.camera;
        draws.fill(-1e9, 1e9, c.position_m);
        draws.fill(-1e9, 1e9, c.target_m);
        draws.fill(-1, 1, c.up);
        c.fov_deg = draws.number(0, 180);
        c.resolution[0] = int(draws.whole(20000)) - 10;
        c.orthographic = draws.whole(8) == 0;
        return camera_fault(scene, scene.ground, c);
    });
    CHECK(cameras > 50);
    CHECK(accepted(4000, [&](Scene& changed) {
              changed = scene;
              changed.sun.azimuth_deg = draws.number(-360, 360);
              changed.sun.elevation_deg = draws.number(-90, 90);
              draws.fill(0, 1e12, changed.sun.irradiance);
              return sun_fault(changed.sun);
          }) > 400);
    CHECK(accepted(1000, [&](Scene& changed) {
              changed = scene;
              draws.fill(0, 1e12, changed.sky.radiance);
              return sky_fault(scene, changed.sky);
          }) > 100);
    CHECK(accepted(2000, [&](Scene& changed) {
              changed = scene;
              changed.ground.altitude_m = draws.number(-1e9, 1e9);
              changed.ground.albedo = draws.number(0, 1);
              return ground_fault(scene, scene.camera, changed.ground);
          }) > 100);
}

TEST_CASE("lights that are accepted at once are sound") {
    const Scene scene = scene_of(
        "[[light]]\ntype = \"point\"\nposition_m = [0, 0, 900]\n[method]\nname = \"path\"\n");
    Draws draws;
    CHECK(accepted(20000, [&](Scene& changed) {
              changed = scene;
              LightSettings l;
              l.type = LampKind(draws.whole(3));
              if (l.type == LampKind::kDirectional) {
                  l.azimuth_deg = draws.number(-360, 360);
                  l.elevation_deg = draws.number(-90, 90);
                  draws.fill(0, 1e9, l.irradiance);
              } else {
                  draws.fill(-1e9, 1e9, l.position_m);
                  draws.fill(0, 1e18, l.intensity);
                  l.radius_m = draws.whole(2) == 0 ? 0 : draws.number(0, 1e9);
                  l.shadow_samples = int(draws.whole(67)) - 1;
              }
              if (l.type == LampKind::kSpot) {
                  draws.fill(-1, 1, l.direction);
                  l.cone_deg = draws.number(0, 360);
                  l.penumbra_deg = draws.number(0, 180);
              }
              changed.lights = {l};
              return lights_fault(scene, scene.ground, changed.lights);
          }) > 500);
    const Scene dark = scene_of("");
    CHECK(lights_fault(dark, dark.ground, scene.lights) != nullptr);
}

TEST_CASE("refused values have the words of a scene's check") {
    const Scene scene = scene_of("");
    Camera camera = scene.camera;
    camera.fov_deg = 180;
    const char* key = camera_fault(scene, scene.ground, camera);
    REQUIRE(key != nullptr);
    CHECK(std::string(key) == "camera.fov_deg");
    const Status status =
        check_changed(key, scene, [&](Scene& changed) { changed.camera = camera; });
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message.find("session: camera.fov_deg: out of range, 180") == 0);
}

}  // namespace pileus
