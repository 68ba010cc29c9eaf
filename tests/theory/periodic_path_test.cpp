// SPDX-License-Identifier: Apache-2.0
// Camera paths through periodic media: a small box that repeats is the slab without end.
// in: small periodic boxes -> out: R and T against tables, Beer's law aslant, a furnace.
// docs/methods.md 2, "Periodic media"; van de Hulst 1980; docs/testing.md "theory".
#include "tests/support/path_harness.h"

namespace {

using namespace path_test;

Rig periodic_slab(double tau, float g, float albedo) {
    Rig rig = make_rig({5, 3, 4}, {1, 0.7, 1}, tau);
    set_albedo(rig, {albedo, albedo, albedo});
    rig.medium.optics[0].phase = {kPhaseHg, g, 0, 1};
    rig.medium.grid.periodic = true;
    set_majorants(rig, 2);
    return rig;
}

TEST_CASE("periodic box by path: van de Hulst's slab: tau 2, g 0.75, albedo 0.9") {
    // The direct light is a delta, which no camera sees: taken off the published transmission.
    for (int side : {1, -1})
        check_mean(
            side > 0 ? "R of a periodic box by path" : "T of a periodic box by path",
            side > 0 ? 0.09739 : 0.66096 - std::exp(-2.0),
            [&](int more, std::uint64_t seed) {
                Rig rig = periodic_slab(2, 0.75f, 0.9f);
                shine(rig, {0, 0, 1});
                // The detector hangs some periods away, just off the face that it looks at.
                const float z = side > 0 ? 1.125f : -0.125f;
                const CameraParams flux =
                    make_flux_view({-3.2f, 7.9f, z}, {0, 0, float(-side)}, 0.5f);
                return film_average(
                    trace_film(path_input(rig, flux, seed), 60000u * unsigned(more)));
            },
            5e-6);
}

TEST_CASE("periodic box by path: slanted rays dim by Beer's law") {
    for (double slope : {0.8, 0.3}) {
        Rig rig = periodic_slab(1, 0, 0);
        set_sky(rig, 1);
        const float sine = float(std::sqrt(1 - slope * slope));
        CameraParams ray =
            make_flat_view({100, -50, -2}, {sine * 0.6f, sine * 0.8f, float(slope)}, 0.1f, 2, 2);
        check_mean("periodic, slanted ray by path, slope " + std::to_string(slope).substr(0, 3),
                   std::exp(-1 / slope), [&](int more, std::uint64_t seed) {
                       return film_average(
                           trace_film(path_input(rig, ray, seed), 20000u * unsigned(more)));
                   });
    }
}

TEST_CASE("periodic box by path: a furnace with a white ground") {
    Rig rig = periodic_slab(3, 0.5f, 1);
    for (std::size_t v = 0; v < voxel_count(rig.medium.grid); v += 2)
        rig.medium.volume.density.data()[v] = 0;
    set_majorants(rig, 1);
    set_sky(rig, 1);
    set_ground(rig, -0.5, 1);
    const CameraParams eye = make_view({0.5f, -9, 2}, {0, 0.96f, -0.28f}, 16, 16);
    const Film film = trace_film(path_input(rig, eye, 5), 64);
    CHECK(film.tally.bounces > 1000);
    CHECK(film.tally.scatterings > 1000);
    for (std::size_t p = 0; p < film.pixels(); ++p) REQUIRE(film_mean(film, 0, 0, p) == 1.0);
}

}  // namespace
