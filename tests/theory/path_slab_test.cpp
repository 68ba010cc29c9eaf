// SPDX-License-Identifier: Apache-2.0
// Flux cameras above and below slabs against published reflection and transmission.
// in: tau, g, albedo, angle of the sun -> out: R and T, each judged in standard errors.
// H. C. van de Hulst, Multiple Light Scattering (1980), table 35; docs/testing.md "theory".
#include "tests/long_tests.h"
#include "tests/path_harness.h"

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
