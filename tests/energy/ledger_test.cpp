// SPDX-License-Identifier: Apache-2.0
// The energy ledger: what is shot is found again, to the last quantum.
// in: white, grey and coloured media, lights, ground -> out: exact integer balances.
// docs/methods.md 3, each image frame, step 1; every comparison is between integers.
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

/// A ball of density 1 that fades over four voxels, in a box of 16 x 12 x 10.
Rig make_cloud(const Float3& albedo, float g) {
    Rig rig = make_rig({16, 12, 10}, {160, 120, 100}, 0.1);
    std::size_t v = 0;
    for (int z = 0; z < 10; ++z)
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 16; ++x, ++v) {
                const double dx = x - 7.5, dy = y - 5.5, dz = z - 4.5;
                const double r = std::sqrt(dx * dx + dy * dy + dz * dz);
                rig.medium.volume.density[v] = float(std::min(1.0, std::max(0.0, 6.0 - r) / 4));
            }
    set_albedo(rig, albedo);
    rig.medium.optics[0].phase.g1 = g;
    set_majorants(rig, 2);
    return rig;
}

void give_ground(Rig& rig, double z, double albedo) {
    rig.lighting.ground.present = true;
    rig.lighting.ground.z = z;
    rig.lighting.ground.albedo = albedo;
}

Light make_light(const Medium& m, int kind) {
    if (kind == 0) return beam_light(m, {0.6, 0, -0.8});
    if (kind == 1) return beam_light(m, {0, 0, -1});
    return diffuse_light(m, kind - 3);  // 2, 3, 4: down, all, up
}

void check_balance(const TraceTally& t, int channels, std::int64_t photons) {
    for (std::size_t c = 0; c < std::size_t(channels); ++c) {
        CHECK(balance(t.light, c) == 0);
        CHECK(balance(t.shadow, c) == 0);
        CHECK(t.light.emitted[c] == photons * kPhotonQuanta);
    }
    for (std::size_t c = std::size_t(channels); c < 3; ++c) CHECK(t.light.emitted[c] == 0);
    CHECK(t.photons == photons);
    CHECK(t.majorant_violations == 0);
}

}  // namespace

TEST_CASE("ledger: a white medium absorbs nothing and loses nothing") {
    constexpr std::int64_t n = 40'000;
    for (int kind = 0; kind < 5; ++kind)
        for (int ground = 0; ground < 3; ++ground) {
            CAPTURE(kind);
            CAPTURE(ground);
            Rig rig = make_cloud({1, 1, 1}, 0.85f);
            add_light(rig, make_light(rig.medium, kind));
            if (ground > 0) give_ground(rig, ground == 1 ? -50 : 0, 0.7);
            const TraceTally t = shoot(rig, n, 11);
            check_balance(t, 1, n);
            CHECK(t.light.absorbed[0] == 0);
            CHECK(t.light.terminated[0] == 0);
            CHECK((t.light.ground[0] > 0) == (ground > 0));
            CHECK((t.light.sky[0] > 0) == (ground > 0));
            CHECK(t.scatterings > 0);
        }
}

TEST_CASE("ledger: absorption is one more fate, per channel") {
    constexpr std::int64_t n = 40'000;
    for (int kind = 0; kind < 5; ++kind)
        for (bool ground : {false, true}) {
            CAPTURE(kind);
            Rig grey = make_cloud({0.9f, 0.9f, 0.9f}, 0.5f);
            Rig colour = make_cloud({0.9f, 0.99f, 1}, 0.5f);
            for (Rig* rig : {&grey, &colour}) {
                add_light(*rig, make_light(rig->medium, kind));
                if (ground) give_ground(*rig, -20, 0.5);
            }
            const TraceTally g = shoot(grey, n, 12), c = shoot(colour, n, 12);
            check_balance(g, 1, n);
            CHECK(g.light.absorbed[0] > 0);
            check_balance(c, 3, n);
            // The channel of albedo 1 has weight 1 all along; darker channels absorb more.
            CHECK(c.light.absorbed[2] == 0);
            CHECK(c.light.absorbed[1] > 0);
            CHECK(c.light.absorbed[0] > c.light.absorbed[1]);
        }
}

TEST_CASE("ledger: a coloured medium agrees with grey ones channel by channel") {
    // Weights (coloured) and roulette (grey) are two estimates of one mean.
    const Float3 albedo{0.9f, 0.99f, 1};
    Rig colour = make_cloud(albedo, 0.5f);
    add_light(colour, make_light(colour.medium, 1));
    const TraceTally many = shoot(colour, 2'000'000, 77);
    for (std::size_t c = 0; c < 3; ++c) {
        Rig grey = make_cloud({albedo[c], albedo[c], albedo[c]}, 0.5f);
        add_light(grey, make_light(grey.medium, 1));
        const double reference = share(many.light.top[c], many);
        // Weights below 1 only lower the spread: a binomial error bounds the reference's.
        const double error = std::sqrt(reference * (1 - reference) / 2e6);
        check_mean("grey of channel " + std::to_string(c) + ": top", reference,
                   [&](int multiple, std::uint64_t seed) {
                       const TraceTally t = shoot(grey, 400'000 * std::uint64_t(multiple), seed);
                       const Mean m = share_mean(t.light.top[0], t);
                       return Mean{m.value, std::hypot(m.error, error)};
                   });
    }
}

TEST_CASE("ledger: photons that exceed their events are tallied as terminated") {
    constexpr std::int64_t n = 20'000;
    for (bool ground : {false, true}) {
        std::int64_t before = n * kPhotonQuanta;
        for (std::uint32_t events : {1u, 4u, 16u, 1u << 16}) {
            Rig rig = make_cloud({1, 1, 1}, 0.85f);
            add_light(rig, make_light(rig.medium, 2));
            if (ground) give_ground(rig, -5, 1);
            rig.max_events = events;
            const TraceTally t = shoot(rig, n, 13);
            check_balance(t, 1, n);
            CHECK(t.light.terminated[0] < before);
            CHECK((t.light.terminated[0] > 0) == (events <= 16));
            CHECK(t.tentative <= n * std::int64_t(events) * (ground ? 2 : 1));
            before = t.light.terminated[0];
        }
    }
}

TEST_CASE("ledger: the ground's missing light is what the medium took out of the straight beam") {
    constexpr std::int64_t n = 40'000;
    Rig rig = make_cloud({0.8f, 0.8f, 0.8f}, 0.85f);
    add_light(rig, make_light(rig.medium, 1));
    give_ground(rig, -50, 0.3);
    const TraceTally t = shoot(rig, n, 14);
    CHECK(t.shadow.emitted[0] == t.light.emitted[0] - t.light.direct_bottom[0]);
    // A black ground owes nothing upwards: all missing light ends in the ground.
    give_ground(rig, -50, 0);
    const TraceTally black = shoot(rig, n, 14);
    CHECK(black.shadow.ground[0] == black.shadow.emitted[0]);
    CHECK(black.light.sky[0] == 0);
    // A white ground keeps nothing.
    give_ground(rig, -50, 1);
    const TraceTally white = shoot(rig, n, 14);
    CHECK(white.light.ground[0] == 0);
    CHECK(white.shadow.ground[0] == 0);
    CHECK(white.light.sky[0] > 0);
}
