// SPDX-License-Identifier: Apache-2.0
// Which lights a ground makes, and what becomes of the light between ground and cloud.
// in: scenes with a ground -> out: lists of lights, energy per light.
// docs/methods.md 3 "Shoot"; docs/collectors.md.
#include "tests/support/render_harness.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

const char* const kText = R"(
seed = 6
[camera]
position_m = [0, -3000, 700]
target_m = [0, 0, 700]
resolution = [32, 18]
[sun]
azimuth_deg = 120
elevation_deg = 40
[ground]
altitude_m = 0
albedo = 0.5
[[medium]]
density = "uniform:box"
bounds_m = [[-500, -500, 500], [500, 500, 900]]
resolution = [8, 8, 8]
extinction_per_m = 0.02
albedo = 1.0
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 200_000
generations = 2
samples = 500
)";

Lighting lighting_of(const std::vector<std::string>& overrides) {
    const Scene scene = render_test::scene_from(kText, overrides);
    Medium medium;
    REQUIRE(load_medium(scene, scene.media[0], 1, medium));
    return make_lighting({scene.sun, scene.sky, scene.ground, scene.lights}, medium,
                         place_of(scene.sun));
}

bool has_light(const Lighting& lighting, const char* name) {
    for (const Light& l : lighting.lights)
        if (l.name == name) return true;
    return false;
}

}  // namespace

TEST_CASE("ground: a light of its own only where its radiance differs") {
    CHECK(has_light(lighting_of({}), "ground"));
    CHECK(!has_light(lighting_of({"ground.albedo=0"}), "ground"));
    // White medium: the sky is taken out as a constant, and the ground is what differs from it.
    const Lighting black = lighting_of({"ground.albedo=0", "sky.radiance=[1, 2, 3]"});
    REQUIRE(has_light(black, "ground"));
    CHECK(black.lights.back().colour[1] == doctest::Approx(-2));
    const Lighting grey =
        lighting_of({"ground.albedo=0", "sky.radiance=[1, 2, 3]", "medium.0.albedo=0.9"});
    CHECK(has_light(grey, "sky"));
    CHECK(!has_light(grey, "ground"));
    // Under sky and sun: albedo (sky + irradiance sin(elevation) / pi).
    const Lighting both = lighting_of({"sky.radiance=[1, 1, 1]", "medium.0.albedo=0.9"});
    CHECK(both.lights.back().colour[0] ==
          doctest::Approx(0.5 * (1 + std::sin(40 * 3.14159265358979 / 180) / 3.14159265358979)));
    CHECK(!has_light(lighting_of({"sun.elevation_deg=-5"}), "sun"));
}

TEST_CASE("ground: power of diffuse light by hemisphere") {
    Rig rig = make_rig({1, 1, 1}, {2, 3, 5}, 1);
    constexpr double pi = 3.14159265358979323846;
    const Light all = diffuse_light(rig.medium, 0), down = diffuse_light(rig.medium, -1),
                up = diffuse_light(rig.medium, 1);
    CHECK(all.power_m2 == doctest::Approx(pi * 2 * (6 + 10 + 15)));
    CHECK(down.power_m2 + up.power_m2 == doctest::Approx(all.power_m2));
    CHECK(down.power_m2 == doctest::Approx(up.power_m2));
    // A beam brings its silhouette.
    CHECK(beam_light(rig.medium, {0.6, 0, -0.8}).power_m2 == doctest::Approx(0.6 * 15 + 0.8 * 6));
}

TEST_CASE("ground: each light's energy is found again in the report") {
    for (const char* albedo : {"0", "0.5", "1"})
        for (const char* sky : {"[0, 0, 0]", "[1, 1, 1]"}) {
            const render_test::Picture p = render_test::render_one(render_test::scene_from(
                kText,
                {std::string("ground.albedo=") + albedo, std::string("sky.radiance=") + sky}));
            REQUIRE(!p.report.photons.energy.empty());
            for (const EnergyRow& row : p.report.photons.energy) {
                CAPTURE(row.light);
                CHECK(row.balance_quanta == 0);
                CHECK(row.absorbed == 0);
                CHECK(row.terminated == 0);
                const double sum = row.top + row.bottom + row.sides + row.ground + row.sky;
                CHECK(sum == doctest::Approx(row.emitted).epsilon(1e-12));
                if (std::string(albedo) == "1") CHECK(row.ground == 0);
                if (std::string(albedo) == "0") CHECK(row.sky == 0);
            }
        }
}

TEST_CASE("ground: what a bounce sends up comes back with the ground's albedo") {
    // Thin box, ground right under it and far wider than high: of the light scattered down once a
    // share `albedo` goes up again and leaves by the top; the rest stays in the ground.
    const double tau = 1e-3, albedo = 0.4;
    Rig rig = make_slab(tau, 1, 0);
    add_light(rig, beam_light(rig.medium, {0, 0, -1}));
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = 0;
    rig.lighting.ground.albedo = albedo;
    const double down = -0.5 * std::expm1(-tau);
    // Scattering once more on the way: at most tau (1 + ln(1/tau)) of what scattered.
    const double model = down * tau * (2 + std::log(1 / tau));
    check_mean(
        "kept by the ground", down * (1 - albedo),
        [&](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, 8'000'000 * std::uint64_t(multiple), seed);
            return share_mean(t.light.ground[0], t);
        },
        model);
    check_mean(
        "sent up by the ground's shadow", -std::expm1(-tau) * albedo,
        [&](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, 8'000'000 * std::uint64_t(multiple), seed);
            return share_mean(t.shadow.top[0], t);
        },
        2 * model);
}
