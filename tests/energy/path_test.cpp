// SPDX-License-Identifier: Apache-2.0
// Camera paths where energy tells the answer: furnaces, empty boxes, the bare ground.
// in: uniform light, boxes and balls -> out: radiances that are known without any transport.
// docs/path.md; docs/testing.md "energy".
#include "kernels_cpu/core/rng.h"
#include "tests/support/path_harness.h"

namespace {

using namespace path_test;

/// Voxels of a bumpy cloud: densities 0 to 1 with holes.
Rig bumpy_cloud(double sigma, int block) {
    Rig rig = make_rig({12, 10, 8}, {120, 100, 80}, sigma);
    Span<float> density = rig.medium.volume.density.span();
    for (std::size_t i = 0; i < density.size; ++i) {
        const auto w = threefry(7u, 7u, std::uint32_t(i), 1u);
        density[i] = uniform(w.a) < 0.5f ? 0.0f : uniform(w.b);
    }
    set_majorants(rig, block);
    return rig;
}

TEST_CASE("a white cloud in a uniform sky is the sky, sample by sample") {
    for (float g : {0.0f, 0.85f}) {
        Rig rig = bumpy_cloud(0.2, 2);
        rig.medium.optics[0].phase = {kPhaseHg, g, 0, 1};
        set_sky(rig, 1);
        for (bool inside : {false, true}) {
            const CameraParams eye = inside ? make_view({60, 50, 40}, {0, 1, 0}, 16, 16)
                                            : make_view({60, -150, 40}, {0, 1, 0}, 16, 16);
            const Film film = trace_film(path_input(rig, eye, 3), 64);
            CHECK(film.tally.scatterings > 1000);
            // Every path ends in the sky with the weight it began with.
            for (std::size_t p = 0; p < film.pixels(); ++p)
                REQUIRE(film_mean(film, 0, 0, p) == 1.0);
        }
    }
}

TEST_CASE("a furnace with a white ground and a grey one") {
    for (double albedo : {1.0, 0.5}) {
        Rig rig = bumpy_cloud(0.05, 4);
        set_sky(rig, 1);
        set_ground(rig, -20, albedo);
        const Film film =
            trace_film(path_input(rig, make_view({60, -100, 60}, {0, 0.8f, -0.6f}, 16, 16), 5), 64);
        CHECK(film.tally.bounces > 1000);
        if (albedo == 1) {
            for (std::size_t p = 0; p < film.pixels(); ++p)
                REQUIRE(film_mean(film, 0, 0, p) == 1.0);
        } else {
            const Mean m = film_average(film);
            CHECK(m.value < 1);
            CHECK(m.value > 0.5);
        }
    }
}

TEST_CASE("a periodic white layer in a uniform sky is the sky, level rays included") {
    Rig rig = bumpy_cloud(0.2, 2);
    rig.medium.grid.periodic = true;
    set_majorants(rig, 2);
    set_sky(rig, 1);
    for (double ground : {0.0, 1.0}) {
        if (ground > 0) set_ground(rig, -20, ground);
        for (float height : {40.0f, 300.0f}) {
            const Film film = trace_film(
                path_input(rig, make_view({-960, 5000, height}, {0, 1, 0}, 16, 16), 3), 32);
            CHECK(film.tally.scatterings > 1000);
            for (std::size_t p = 0; p < film.pixels(); ++p)
                REQUIRE(film_mean(film, 0, 0, p) == 1.0);
        }
    }
}

TEST_CASE("an empty box shows the sky; the sun is never seen") {
    Rig rig = make_rig({4, 4, 4}, {4, 4, 4}, 1);
    for (float& v : rig.medium.volume.density.span()) v = 0;
    set_majorants(rig, 2);
    shine(rig, {0, 1, 0});
    set_sky(rig, 0.25);
    const Film film = trace_film(path_input(rig, make_view({2, -2, 2}, {0, 1, 0}, 9, 9), 1), 16);
    for (std::size_t p = 0; p < film.pixels(); ++p) CHECK(film_mean(film, 0, 2, p) == 0.25);
    CHECK(film.tally.shadow_rays == 0);
}

TEST_CASE("the bare ground under sun and sky has its closed form") {
    Rig rig = make_rig({2, 2, 2}, {2, 2, 2}, 0);
    set_majorants(rig, 1);
    shine(rig, {0.6f, 0, 0.8f}, 3);
    set_sky(rig, 0.5);
    set_ground(rig, -1, 0.3);
    const Film film = trace_film(path_input(rig, make_view({1, 1, 9}, {0, 0, -1}, 8, 8), 1), 16);
    const double exact = 0.3 * (0.5 + 3 * 0.8 / 3.14159265358979);
    for (std::size_t p = 0; p < film.pixels(); ++p)
        CHECK(film_mean(film, 0, 0, p) == doctest::Approx(exact).epsilon(1e-6));
}

TEST_CASE("an absorbing box dims the sky by Beer's law, and shades the ground") {
    Rig rig = make_rig({3, 3, 3}, {3, 3, 3}, 0.5);
    set_albedo(rig, {0, 0, 0});
    set_majorants(rig, 1);
    set_sky(rig, 1);
    check_mean("Beer's law across a black box", std::exp(-1.5), [&](int more, std::uint64_t seed) {
        const CameraParams eye = make_flat_view({1.5f, -4, 1.5f}, {0, 1, 0}, 1, 8, 8);
        return film_average(trace_film(path_input(rig, eye, seed), 2000u * unsigned(more)));
    });
    // The flat view from below the box's shadow: all of its sunlight crossed 3 m of medium.
    rig.lighting.sky = {};
    shine(rig, {0, 0, 1});
    set_ground(rig, 0, 1);
    check_mean(
        "sun on the ground under a black box", std::exp(-1.5) / 3.14159265358979 * std::exp(-1.5),
        [&](int more, std::uint64_t seed) {
            const CameraParams eye = make_flat_view({1.5f, 1.5f, 4}, {0, 0, -1}, 1, 8, 8);
            return film_average(trace_film(path_input(rig, eye, seed), 2000u * unsigned(more)));
        });
}

TEST_CASE("a flux camera in a uniform sky reads pi") {
    Rig rig = bumpy_cloud(0.1, 2);
    set_sky(rig, 1);
    const Film film =
        trace_film(path_input(rig, make_flux_view({60, 50, 100}, {0, 0, -1}, 60), 1), 4096);
    CHECK(film_mean(film, 0, 0, 0) == doctest::Approx(3.14159265358979).epsilon(1e-6));
}

}  // namespace
