// SPDX-License-Identifier: Apache-2.0
// Flux cameras above and below slabs against published reflection and transmission.
// in: tau, g, albedo, angle of the sun -> out: R and T, each judged in standard errors.
// H. C. van de Hulst, Multiple Light Scattering (1980), table 35; docs/testing.md "theory".
#include "tests/support/long_tests.h"
#include "tests/support/path_harness.h"

namespace {

using namespace path_test;

/// Share of the sun's flux through the slab's top that comes back out (1) or passes (-1).
Mean slab_share(float tau, float g, float albedo, float mu0, int side, int more,
                std::uint64_t seed) {
    Rig rig = make_slab(double(tau), albedo, g);
    const float sine = std::sqrt(1 - mu0 * mu0);
    shine(rig, {sine, 0, mu0}, 1 / double(mu0));
    const float middle = float(kSlabWidth / 2);
    const CameraParams flux =
        make_flux_view({middle, middle, side > 0 ? 1.0f : 0.0f}, {0, 0, float(-side)}, 10);
    return film_average(trace_film(path_input(rig, flux, seed),
                                   1500000u * unsigned(more) * (long_tests() ? 64u : 1u)));
}

/// The same slab of 8 x 8 voxels 0.5 m across that repeats without end.
Mean periodic_share(float mu0, int side, int more, std::uint64_t seed) {
    Rig rig = make_rig({8, 8, 2}, {4, 4, 1}, 2);
    rig.medium.grid.periodic = true;
    rig.medium.optics[0].phase = {kPhaseHg, 0.75f, 0, 1};
    set_albedo(rig, {0.9f, 0.9f, 0.9f});
    set_majorants(rig, 4);
    shine(rig, {0.6f * std::sqrt(1 - mu0 * mu0), 0.8f * std::sqrt(1 - mu0 * mu0), mu0},
          1 / double(mu0));
    // The detector lies far from the box's own period.
    const CameraParams flux =
        make_flux_view({-37, 1001, side > 0 ? 1.0f : 0.0f}, {0, 0, float(-side)}, 3);
    return film_average(trace_film(path_input(rig, flux, seed), 300000u * unsigned(more)));
}

TEST_CASE("a periodic box is a slab") {
    for (int side : {1, -1}) {
        const double exact = side > 0 ? 0.09739 : 0.66096 - std::exp(-2.0);
        check_mean(
            side > 0 ? "periodic R" : "periodic T", exact,
            [&](int more, std::uint64_t seed) { return periodic_share(1, side, more, seed); },
            5e-6);
        // At a slant the wide slab itself is the reference.
        check_mean(
            side > 0 ? "periodic R at a slant, less the slab's"
                     : "periodic T at a slant, less the slab's",
            0, [&](int more, std::uint64_t seed) {
                const Mean a = periodic_share(0.3f, side, more, seed);
                const Mean b = slab_share(2, 0.75f, 0.9f, 0.3f, side, more, seed + 9);
                return Mean{a.value - b.value, std::sqrt(a.error * a.error + b.error * b.error)};
            });
    }
}

TEST_CASE("van de Hulst's slab: tau 2, g 0.75, albedo 0.9") {
    // The direct light is a delta, which no camera sees: taken off the published transmission.
    check_mean(
        "R, tau 2 g .75 albedo .9", 0.09739,
        [](int more, std::uint64_t seed) { return slab_share(2, 0.75f, 0.9f, 1, 1, more, seed); },
        5e-6);
    check_mean(
        "T, tau 2 g .75 albedo .9", 0.66096 - std::exp(-2.0),
        [](int more, std::uint64_t seed) { return slab_share(2, 0.75f, 0.9f, 1, -1, more, seed); },
        5e-6);
}

}  // namespace
