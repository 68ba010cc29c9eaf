// SPDX-License-Identifier: Apache-2.0
// Limits with a closed form: thin slabs, no scattering, scattering that turns by 0 or 180 degrees.
// in: slabs and spheres -> out: a row per share.
// Beer-Lambert law; Henyey-Greenstein in closed form.
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

Light overhead(const Rig& rig) { return beam_light(rig.medium, {0, 0, -1}); }

}  // namespace

TEST_CASE("thin: the scattered share is the optical depth") {
    for (double tau : {1e-4, 1e-3}) {
        Rig rig = make_slab(tau, 1, 0);
        add_light(rig, overhead(rig));
        char name[64];
        std::snprintf(name, sizeof name, "tau %g scattered", tau);
        check_mean(name, -std::expm1(-tau), [&](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, 20'000'000 * std::uint64_t(multiple), seed);
            return share_mean(t.light.emitted[0] - t.light.direct_bottom[0], t);
        });
    }
}

TEST_CASE("thin: without scattering the beam is attenuated exponentially") {
    for (double tau : {1e-3, 0.1, 1.0, 5.0, 10.0}) {
        Rig rig = make_slab(tau, 0, 0);
        add_light(rig, overhead(rig));
        char name[64];
        std::snprintf(name, sizeof name, "albedo 0 tau %g T", tau);
        check_mean(name, std::exp(-tau), [&](int multiple, std::uint64_t seed) {
            const TraceTally t = shoot(rig, 4'000'000 * std::uint64_t(multiple), seed);
            CHECK(t.light.top[0] == 0);
            CHECK(t.light.absorbed[0] + t.light.bottom[0] + t.light.sides[0] == t.light.emitted[0]);
            CHECK(t.light.direct_bottom[0] == t.light.bottom[0]);
            return share_mean(t.light.bottom[0], t);
        });
    }
    // At optical depth 20 one photon in 5e8 passes: of a million a third one has odds below 1e-8.
    Rig rig = make_slab(20, 0, 0);
    add_light(rig, overhead(rig));
    CHECK(shoot(rig, 1'000'000, 5).light.bottom[0] <= 2 * kPhotonQuanta);
}

TEST_CASE("thin: scattering straight on or straight back") {
    for (double tau : {1.0, 50.0}) {
        Rig rig = make_slab(tau, 1, 1);
        add_light(rig, overhead(rig));
        const TraceTally t = shoot(rig, 100'000, 3);
        CHECK(t.light.bottom[0] == t.light.emitted[0]);
        CHECK(t.scatterings > 0);
    }
    Rig rig = make_slab(5, 1, -1);
    add_light(rig, overhead(rig));
    check_mean("g -1 tau 5 T", 1.0 / 6.0, [&](int multiple, std::uint64_t seed) {
        const TraceTally t = shoot(rig, 1'000'000 * std::uint64_t(multiple), seed);
        CHECK(t.light.sides[0] == 0);
        return share_mean(t.light.bottom[0], t);
    });
}

TEST_CASE("thin: first scattering of a beam by a slab, up and down") {
    // Share that leaves upwards after one turn: isotropic gives half of 1 - exp(-tau); for HG the
    // backward half of the phase function, (1-g)/2g ((1+g)/sqrt(1+g^2) - 1). More turns: O(tau^2).
    const double tau = 1e-3;
    for (double g : {0.0, 0.5, 0.85, -0.85}) {
        Rig rig = make_slab(tau, 1, float(g));
        add_light(rig, overhead(rig));
        const double back = g == 0 ? 0.5 : (1 - g) / (2 * g) * ((1 + g) / std::sqrt(1 + g * g) - 1);
        char name[64];
        std::snprintf(name, sizeof name, "tau 1e-3 g %g R", g);
        // Photons turned nearly sideways scatter again: at most tau * (1 + ln(1/tau)) of them.
        const double model = tau * tau * (1 + std::log(1 / tau));
        check_mean(
            name, -std::expm1(-tau) * back,
            [&](int multiple, std::uint64_t seed) {
                const TraceTally t = shoot(rig, 8'000'000 * std::uint64_t(multiple), seed);
                return share_mean(t.light.top[0], t);
            },
            model);
    }
}
