// SPDX-License-Identifier: Apache-2.0
// A thin sphere in sunlight, whose singly scattered light has a closed form.
// in: optical depth 0.02 across, a phase function, angles -> out: radiance over the closed form.
// docs/path.md: irradiance x albedo x phase function x the mean depth that both ways see.
#include "tests/support/path_harness.h"

namespace {

using namespace path_test;

/// A ball of 32 voxels across, 2 m wide, of the extinction given: its edge is a voxel's staircase.
Rig make_ball(double sigma) {
    Rig rig = make_rig({32, 32, 32}, {2, 2, 2}, sigma);
    std::size_t v = 0;
    for (int z = 0; z < 32; ++z)
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x, ++v) {
                const double a = x - 15.5, b = y - 15.5, c = z - 15.5;
                rig.medium.volume.density[v] = a * a + b * b + c * c <= 256 ? 1.0f : 0.0f;
            }
    set_majorants(rig, 4);
    return rig;
}

TEST_CASE("single scattering of a thin ball is its mass times the phase function") {
    const double tau = 0.002;
    for (float g : {0.0f, 0.8f})
        for (float cosine : {1.0f, 0.0f, -0.8f}) {
            Rig rig = make_ball(tau / 2);
            rig.medium.optics[0].phase = {kPhaseHg, g, 0, 1};
            set_albedo(rig, {0.5f, 0.5f, 0.5f});
            // The camera looks north; light that turns by the angle comes from there.
            shine(rig, {std::sqrt(1 - cosine * cosine), cosine, 0}, 3);
            double mass = 0;
            for (float density : rig.medium.volume.density.span()) mass += double(density);
            mass *= tau / 2 / (16.0 * 16 * 16);
            const double p =
                (1 - double(g) * double(g)) /
                (4 * 3.14159265358979 *
                 std::pow(1 + double(g) * double(g) - 2 * double(g) * double(cosine), 1.5));
            // Both ways together lose at most tau, and the media scatter again at most tau / 2.
            const double exact = 3 * 0.5 * p * mass / 4;
            char name[64];
            std::snprintf(name, sizeof name, "thin ball, g %g, cosine %g", double(g),
                          double(cosine));
            check_mean(
                name, exact,
                [&](int more, std::uint64_t seed) {
                    PathInput in =
                        path_input(rig, make_flat_view({1, -5, 1}, {0, 1, 0}, 2, 16, 16), seed);
                    in.rules.max_depth = 1;
                    return film_average(trace_film(in, 36000u * unsigned(more)));
                },
                exact * tau);
        }
}

}  // namespace
