// SPDX-License-Identifier: Apache-2.0
// Two media on one grid: exact ledgers, what each absorbs, mean paths.
// in: shares of a field for each medium, albedos, phase functions -> out: integer balances, means.
// docs/methods.md 2, "Several media"; Blanco and Fournier 2003 for the mean path.
#include "tests/support/media_harness.h"

using namespace trace_test;

namespace {

/// Cells of contrast 1 : `low`, half of each medium's in the other's place.
Rig make_pair(float low, const Optics& first, const Optics& second) {
    Rig rig = make_rig({8, 7, 6}, {8, 7, 6}, 2);
    std::size_t v = 0;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 8; ++x, ++v)
                rig.medium.volume.density[v] = (x + y + z) % 2 == 0 ? 1.0f : low;
    rig.medium.optics[0] = first;
    split(rig, second, [](std::size_t voxel) { return double(voxel % 3) / 2; });
    set_majorants(rig, 2);
    return rig;
}

}  // namespace

TEST_CASE("media: mean path and scatterings of two white media, contrast a million") {
    const PhaseParams phases[3] = {
        {kPhaseHg, 0.9f, 0, 1}, {kPhaseRayleigh, 0, 0, 1}, {kPhaseTwoLobe, 0.8f, -0.6f, 0.5f}};
    for (int i = 0; i < 3; ++i) {
        Rig rig = make_pair(1e-6f, optics_of({1, 1, 1}, phases[i]),
                            optics_of({1, 1, 1}, phases[(i + 1) % 3]));
        rig.max_events = 1u << 26;
        add_light(rig, diffuse_light(rig.medium, 0));
        const std::string name = "two media, pair " + std::to_string(i);
        check_mean(name + ": mean path", mean_chord(rig), [&](int multiple, std::uint64_t seed) {
            return batch_mean(rig, 100'000 * std::uint64_t(multiple), seed,
                              [&](const TraceTally& t) {
                                  CHECK(balance(t.light, 0) == 0);
                                  CHECK(t.light.absorbed[0] == 0);
                                  CHECK(t.light.terminated[0] == 0);
                                  return mean_path(rig, t);
                              });
        });
        // Half of the voxels are full: sigma times the mean density, in mean chords.
        check_mean(name + ": scatterings", 2 * (0.5 + 0.5e-6) * mean_chord(rig),
                   [&](int multiple, std::uint64_t seed) {
                       return batch_mean(rig, 100'000 * std::uint64_t(multiple), seed,
                                         [&](const TraceTally& t) {
                                             return double(t.scatterings) / double(t.photons);
                                         });
                   });
    }
}

TEST_CASE("media: straight light loses what each medium takes, exactly") {
    // Forward scattering alone does not turn: 1 - exp(-sum of (1 - albedo) tau) is absorbed.
    const PhaseParams straight{kPhaseHg, 1, 0, 1};
    const float kAlbedo[2][3] = {{1, 1, 1}, {0.25f, 0.5f, 0.875f}};
    for (double tau : {1e-3, 0.1, 2.0})
        for (double share : {0.0, 0.25, 1.0})
            for (int channels : {1, 3}) {
                Rig rig = make_slab(tau, 1, 1);
                split(rig,
                      channels == 3
                          ? optics_of({kAlbedo[1][0], kAlbedo[1][1], kAlbedo[1][2]}, straight)
                          : optics_of({0.5f, 0.5f, 0.5f}, straight),
                      [&](std::size_t) { return share; });
                add_light(rig, beam_light(rig.medium, {0, 0, -1}));
                for (int c = 0; c < channels; ++c) {
                    const double kept = channels == 3 ? double(kAlbedo[1][c]) : 0.5;
                    const double expected = -std::expm1(-tau * share * (1 - kept));
                    char name[80];
                    std::snprintf(name, sizeof name, "tau %g share %g channel %d of %d: absorbed",
                                  tau, share, c, channels);
                    check_mean(name, expected, [&](int multiple, std::uint64_t seed) {
                        return batch_mean(
                            rig, 400'000 * std::uint64_t(multiple), seed, [&](const TraceTally& t) {
                                CHECK(balance(t.light, std::size_t(c)) == 0);
                                return double(t.light.absorbed[c]) / double(t.light.emitted[c]);
                            });
                    });
                }
                if (share == 0) CHECK(shoot(rig, 10'000, 1).light.absorbed[0] == 0);
            }
}

TEST_CASE("media: the ledger balances to the quantum, ground and colours included") {
    Rig rig = make_pair(0.01f, optics_of({0.9f, 0.99f, 1}, {kPhaseHg, 0.8f, 0, 1}),
                        optics_of({0.5f, 0.5f, 0.5f}, {kPhaseRayleigh, 0, 0, 1}));
    rig.medium.channels = 3;
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = -1;
    rig.lighting.ground.albedo = 0.7;
    add_light(rig, beam_light(rig.medium, {0.48, 0.36, -0.8}));
    const TraceTally t = shoot(rig, 50'000, 7);
    CHECK(t.shadow.emitted[0] > 0);
    CHECK(t.light.absorbed[0] > t.light.absorbed[2]);
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(balance(t.light, c) == 0);
        CHECK(balance(t.shadow, c) == 0);
    }
}

TEST_CASE("media: a medium that is alike draws nothing anew") {
    // The draw has random numbers of its own, so that photons and their paths stay the same.
    const Optics both = optics_of({0.9f, 0.9f, 0.9f}, {kPhaseHg, 0.7f, 0, 1});
    Rig two = make_pair(0.1f, both, both);
    Rig one = make_pair(0.1f, both, both);
    one.medium.count = 1;
    for (Rig* rig : {&one, &two}) add_light(*rig, beam_light(rig->medium, {0.48, 0.36, -0.8}));
    const TraceTally a = shoot(one, 30'000, 3), b = shoot(two, 30'000, 3);
    CHECK(std::memcmp(&a, &b, sizeof a) == 0);
    two.medium.optics[1].phase.g1 = 0.69f;
    const TraceTally c = shoot(two, 30'000, 3);
    CHECK(std::memcmp(&a, &c, sizeof a) != 0);
}
