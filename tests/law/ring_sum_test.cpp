// SPDX-License-Identifier: Apache-2.0
// The light of a ring as one slot: whole numbers that come and go leave nothing behind.
// in: slots of made-up sums -> out: their sum against one made anew, and against each slot.
// docs/collectors.md, "The ring of generations"
#include "src/photons/ring_sum.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace pileus;

namespace {

constexpr SlotSize kSize{5, 1, 4, 3};  // 23 numbers a light
constexpr std::size_t kLights = 2, kSlots = 4;

/// Numbers of generation g, of every size and sign that sums have.
void shoot(std::uint64_t g, double flux, PhotonSlot& slot) {
    empty_slot(slot, 1);
    for (std::size_t i = 0; i < slot.sums.size(); ++i) {
        const std::int64_t v = std::int64_t((g * 7919 + i * 104729) % 1000003) - 400000;
        slot.sums[i] = v << (i % 30);
    }
    slot.generations = 1;
    slot.scatterings = std::int64_t(g);
    slot.flux_per_photon_m2 = {flux, 3.0};
    slot.sun_travel = {float(g), 0, -1};
    slot.parts.clear();
    ++slot.serial;
}

Photons empty_ring() {
    Photons photons;
    photons.slots.resize(kSlots);
    for (PhotonSlot& slot : photons.slots)
        REQUIRE(allocate(arrays::photon_slot(kSize, kLights), slot.sums));
    return photons;
}

/// The sum of the same slots, made at once.
RingSum anew(Photons& photons, std::size_t newest) {
    RingSum ring;
    REQUIRE(sum_ring(kSize, kLights, newest, 2, photons, ring));
    return ring;
}

void check_same(const RingSum& a, const RingSum& b) {
    CHECK(a.unit == b.unit);
    CHECK(a.sum.generations == b.sum.generations);
    CHECK(a.sum.scatterings == b.sum.scatterings);
    CHECK(a.sum.sun_travel == b.sum.sun_travel);
    bool same = a.sum.sums.size() == b.sum.sums.size();
    for (std::size_t i = 0; same && i < a.sum.sums.size(); ++i)
        same = a.sum.sums[i] == b.sum.sums[i];
    CHECK(same);
}

}  // namespace

TEST_CASE("ring sum: generations that give way leave no trace, under a sun that climbs") {
    Photons photons = empty_ring();
    RingSum ring;
    for (std::uint64_t g = 0; g < 60; ++g) {
        const std::size_t s = std::size_t(g % kSlots);
        // Stands, climbs through a unit of the sum, sinks, sets, and stands again.
        const double flux = g < 10   ? 0.9
                            : g < 30 ? 0.9 + 0.01 * double(g - 10)
                            : g < 40 ? 1.1 - 0.1 * double(g - 30)
                            : g < 45 ? 0
                                     : 0.7;
        take_out(s, 2, photons, ring);
        shoot(g, flux, photons.slots[s]);
        if (g % 3 == 0) continue;  // not every generation is shown
        REQUIRE(sum_ring(kSize, kLights, s, 2, photons, ring));
        check_same(ring, anew(photons, s));
    }
}

TEST_CASE("ring sum: under a sun that stands it is the slots' own numbers") {
    Photons photons = empty_ring();
    for (std::uint64_t g = 0; g < kSlots; ++g) shoot(g, 0.3, photons.slots[g]);
    const RingSum ring = anew(photons, 2);
    CHECK(ring.unit == std::vector<double>{0.3, 3.0});
    CHECK(ring.sum.generations == kSlots);
    for (std::size_t i = 0; i < ring.sum.sums.size(); ++i) {
        std::int64_t all = 0;
        for (const PhotonSlot& slot : photons.slots) all += slot.sums[i];
        CHECK(ring.sum.sums[i] == all);
    }
}

TEST_CASE("ring sum: slots of other fluxes keep their power to half a unit each") {
    Photons photons = empty_ring();
    const double fluxes[kSlots] = {0.011, 0.3, 15.9, 4};
    for (std::uint64_t g = 0; g < kSlots; ++g) shoot(g, fluxes[g], photons.slots[g]);
    const RingSum ring = anew(photons, 0);
    CHECK(ring.unit[0] == 16);
    CHECK(ring.unit[1] == 3);
    for (std::size_t i = 0; i < kSize.numbers(); ++i) {
        double power = 0, size = 0;
        for (std::size_t s = 0; s < kSlots; ++s) {
            power += double(photons.slots[s].sums[i]) * fluxes[s];
            size += std::abs(double(photons.slots[s].sums[i])) * fluxes[s];
        }
        // Half a unit a slot, and the roundings of this sum itself.
        CHECK(std::abs(double(ring.sum.sums[i]) * 16 - power) <= 0.5 * 16 * kSlots + 1e-14 * size);
    }
}

TEST_CASE("ring sum: a generation that was ended within counts for what it shot") {
    Photons photons = empty_ring();
    for (std::uint64_t g = 0; g < kSlots; ++g) shoot(g, 0.3, photons.slots[g]);
    photons.slots[1].parts = {0.25, 0};
    const RingSum ring = anew(photons, 0);
    CHECK(ring.unit[0] == 0.3);
    const auto own = [&](std::size_t s) { return double(photons.slots[s].sums[3]); };
    const double power = own(0) + own(1) / 1.25 + own(2) + own(3);
    CHECK(std::abs(double(ring.sum.sums[3]) - power) <= 0.5 + 1e-14 * std::abs(power));
}

TEST_CASE("ring sum: slots that changed by themselves are counted anew") {
    Photons photons = empty_ring();
    for (std::uint64_t g = 0; g < kSlots; ++g) shoot(g, 0.3, photons.slots[g]);
    RingSum ring = anew(photons, 0);
    shoot(9, 0.3, photons.slots[2]);  // without take_out
    REQUIRE(sum_ring(kSize, kLights, 2, 2, photons, ring));
    check_same(ring, anew(photons, 2));
}
