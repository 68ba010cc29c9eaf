// SPDX-License-Identifier: Apache-2.0
// Diffuse light in a white medium: exact means, whatever the density and the phase function.
// in: fields of high contrast -> out: mean path 4V/S, mean scatterings, cost of tracking.
// Blanco and Fournier 2003, "An invariance property of diffusive random walks".
#include "kernels_cpu/isa/kernels.h"
#include "src/world/density/cumulus.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

Rig make_cumulus_rig(float floor_density) {
    Rig rig = make_rig({48, 48, 32}, {1600, 1600, 1100}, 0.05);
    CumulusSettings settings;
    settings.resolution = {48, 48, 32};
    REQUIRE(make_cumulus(settings, *kernel_table(nullptr), 1, rig.medium.volume));
    for (float& v : rig.medium.volume.density.span()) v = std::max(v, floor_density);
    return rig;
}

Rig make_checkerboard(float low) {
    Rig rig = make_rig({8, 7, 6}, {8, 7, 6}, 2);
    std::size_t v = 0;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 8; ++x, ++v)
                rig.medium.volume.density[v] = (x + y + z) % 2 == 0 ? 1.0f : low;
    return rig;
}

/// Mean scatterings by uniform fluence: sigma * mass * 4 / S; the trilinear field has the mass of
/// its voxels.
double mean_scatterings(const Rig& rig) {
    double mean = 0;
    for (float v : rig.medium.volume.density.span()) mean += double(v);
    mean /= double(rig.medium.volume.density.size());
    return double(rig.medium.sigma) * mean * mean_chord(rig);
}

void check_invariance(const std::string& name, Rig& rig, std::uint64_t photons) {
    rig.max_events = 1u << 26;
    rig.lighting.lights.clear();
    add_light(rig, diffuse_light(rig.medium, 0));
    check_mean(name + ": mean path", mean_chord(rig), [&](int multiple, std::uint64_t seed) {
        return batch_mean(rig, photons * std::uint64_t(multiple), seed, [&](const TraceTally& t) {
            CHECK(t.light.terminated[0] == 0);
            CHECK(t.majorant_violations == 0);
            return mean_path(rig, t);
        });
    });
    check_mean(
        name + ": scatterings", mean_scatterings(rig), [&](int multiple, std::uint64_t seed) {
            return batch_mean(
                rig, photons * std::uint64_t(multiple), seed,
                [&](const TraceTally& t) { return double(t.scatterings) / double(t.photons); });
        });
}

}  // namespace

TEST_CASE("mean path: a cumulus with a contrast of a million") {
    Rig rig = make_cumulus_rig(1e-6f);
    for (float g : {0.0f, 0.85f}) {
        rig.medium.optics[0].phase.g1 = g;
        set_majorants(rig, 4);
        char name[64];
        std::snprintf(name, sizeof name, "cumulus g %g local", double(g));
        check_invariance(name, rig, 200'000);
    }
    set_majorants(rig, 0);
    check_invariance("cumulus g 0.85 global", rig, 100'000);
}

TEST_CASE("mean path: checkerboards, local and global") {
    for (float low : {0.1f, 1e-6f}) {
        Rig rig = make_checkerboard(low);
        for (float g : {-0.5f, 0.0f, 0.85f})
            for (int block : {0, 1, 3}) {
                rig.medium.optics[0].phase.g1 = g;
                set_majorants(rig, block);
                char name[80];
                std::snprintf(name, sizeof name, "checkerboard 1:%g g %g block %d", double(low),
                              double(g), block);
                check_invariance(name, rig, 100'000);
            }
    }
}

TEST_CASE("mean path: other phase functions") {
    Rig rig = make_checkerboard(0.01f);
    set_majorants(rig, 2);
    rig.medium.optics[0].phase = {kPhaseRayleigh, 0, 0, 1};
    check_invariance("checkerboard Rayleigh", rig, 100'000);
    rig.medium.optics[0].phase = {kPhaseTwoLobe, 0.9f, -0.3f, 0.7f};
    check_invariance("checkerboard two lobes", rig, 100'000);
}

TEST_CASE("mean path: a slab lit diffusely from both sides scatters 2 tau times") {
    for (double tau : {1.0, 10.0, 30.0})
        for (float g : {0.0f, 0.85f, -0.5f}) {
            Rig rig = make_slab(tau, 1, g);
            add_light(rig, diffuse_light(rig.medium, 0));
            char name[64];
            std::snprintf(name, sizeof name, "slab tau %g g %g: scatterings", tau, double(g));
            // The sides are part of the box: 4V/S is 2 (1 - 2e-5) thicknesses.
            check_mean(name, tau * mean_chord(rig), [&](int multiple, std::uint64_t seed) {
                return batch_mean(
                    rig, 100'000 * std::uint64_t(multiple), seed,
                    [&](const TraceTally& t) { return double(t.scatterings) / double(t.photons); });
            });
            CHECK(tau * mean_chord(rig) == doctest::Approx(2 * tau).epsilon(1e-4));
        }
}
