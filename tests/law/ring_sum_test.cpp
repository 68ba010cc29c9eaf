// SPDX-License-Identifier: Apache-2.0
// The light of a ring as one slot: packed numbers that come and go leave nothing behind.
// in: made-up sums of generations -> out: packed slots against their numbers, the ring's sum
// against one made anew. docs/collectors.md, "The ring of generations"
#include "src/photons/ring_sum.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace pileus;

namespace {

constexpr SlotSize kSize{2100, 1, 9, 3};  // more sets than one piece of work has
constexpr std::size_t kShining = 2, kSlots = 4;
constexpr int kBlocks = 3;
constexpr double kMaxError = 0x1p-10;  // of a set's largest number

struct Ring {
    Photons photons;
    RingSum sum;
    TraceScratch scratch;
    RingWork work{kSize, 2, kernel_table(nullptr)};
};

void open_ring(Ring& ring, const SlotSize& size = kSize) {
    ring.work.size = size;
    ring.photons.slots.resize(kSlots);
    for (PhotonSlot& slot : ring.photons.slots) REQUIRE(allocate_slot(size, kShining, true, slot));
    ring.scratch.stride = size.numbers() + 5;
    ring.scratch.blocks = kBlocks;
    REQUIRE(ring.scratch.sums.resize(ring.scratch.stride * kBlocks, "sums"));
}

/// Number i of a light of generation g: every size and sign that sums have, and sets of zeros.
std::int64_t number_of(const SlotSize& size, std::uint64_t g, std::size_t light, std::uint64_t i) {
    const std::uint64_t set = i / size.coefficients;
    if ((set + g) % 11 == 0) return 0;
    const std::uint64_t drawn = (g * 7919 + i * 104729 + light * 31) * 0x9e3779b97f4a7c15ull >> 44;
    return (std::int64_t(drawn) - 400000) * (std::int64_t{1} << (set % 38));
}

/// Lays generation g into the scratch of all threads.
void scatter(Ring& ring, std::uint64_t g, std::size_t light) {
    for (std::uint64_t i = 0; i < ring.work.size.numbers(); ++i) {
        std::int64_t left = number_of(ring.work.size, g, light, i);
        for (int t = 0; t + 1 < kBlocks; ++t) {
            const std::int64_t part = left / 3 - t * 17;
            ring.scratch.sums[std::uint64_t(t) * ring.scratch.stride + i] = part;
            left -= part;
        }
        ring.scratch.sums[(kBlocks - 1) * ring.scratch.stride + i] = left;
    }
}

void shoot(Ring& ring, std::uint64_t g, const std::vector<double>& flux, std::size_t s) {
    const RingShot shot = begin_shot(s, g < kSlots, flux, ring.photons, ring.sum);
    PhotonSlot& slot = ring.photons.slots[s];
    slot.sun_travel = {float(g), 0, -1};
    for (std::size_t l = 0; l < kShining; ++l) {
        scatter(ring, g, l);
        pack_light(ring.work, l, shot, ring.scratch, ring.photons, ring.sum);
    }
    // As trace_generation does.
    slot.generations = 1;
    slot.scatterings = std::int64_t(g);
    ++slot.serial;
    end_shot(shot, ring.photons, ring.sum);
}

/// The sum of the same slots, made at once.
RingSum anew(Ring& ring, std::size_t newest) {
    RingSum sum;
    REQUIRE(sum_ring(ring.work, newest, ring.photons, sum));
    return sum;
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

/// All numbers of a light of a slot, in its own unit.
std::vector<std::int64_t> numbers_of(const PhotonSlot& slot, std::size_t light) {
    std::vector<std::int64_t> out(std::size_t(slot.packed.count * slot.packed.numbers));
    const auto n = int(slot.packed.numbers);
    for (std::uint64_t set = 0; set < slot.packed.count; ++set)
        numbers_of_set(slot, light, 0, set, n, out.data() + set * slot.packed.numbers);
    const std::size_t ground = slot.packed.ground.size() / kShining;
    const std::int64_t* cells = ground_of(slot, light, kShining, ground);
    out.insert(out.end(), cells, cells + ground);
    return out;
}

}  // namespace

TEST_CASE("ring sum: generations that give way leave no trace, under a sun that climbs") {
    Ring ring;
    open_ring(ring);
    for (std::uint64_t g = 0; g < 60; ++g) {
        const std::size_t s = std::size_t(g % kSlots);
        // Stands, climbs through a unit of the sum, sinks, sets, and stands again.
        const double flux = g < 10   ? 0.9
                            : g < 30 ? 0.9 + 0.01 * double(g - 10)
                            : g < 40 ? 1.1 - 0.1 * double(g - 30)
                            : g < 45 ? 0
                                     : 0.7;
        shoot(ring, g, {flux, 3.0}, s);
        if (g % 3 == 0) continue;  // not every generation is shown
        REQUIRE(sum_ring(ring.work, s, ring.photons, ring.sum));
        check_same(ring.sum, anew(ring, s));
    }
}

TEST_CASE("ring sum: the scratch is left empty") {
    Ring ring;
    open_ring(ring);
    shoot(ring, 3, {0.3, 3.0}, 0);
    std::int64_t left = 0;
    for (std::uint64_t t = 0; t < kBlocks; ++t)
        for (std::uint64_t i = 0; i < kSize.numbers(); ++i)
            left |= ring.scratch.sums[t * ring.scratch.stride + i];
    CHECK(left == 0);
}

TEST_CASE("ring sum: a packed number is wrong by 2^-10 of its set's largest at most") {
    // Sets of one number to the most; the kernels know some sizes by heart.
    for (const std::uint64_t coefficients : {1, 2, 16, 24, 25, 81}) {
        const SlotSize size{97, 1, coefficients, 2};
        CAPTURE(coefficients);
        Ring ring;
        open_ring(ring, size);
        const double flux[kShining] = {0.77, 4.0}, unit[kShining] = {1, 4};
        shoot(ring, 5, {flux[0], flux[1]}, 0);
        for (std::size_t l = 0; l < kShining; ++l) {
            CHECK(ring.photons.slots[0].flux_per_photon_m2[l] == unit[l]);
            const std::vector<std::int64_t> kept = numbers_of(ring.photons.slots[0], l);
            double worst = 0;
            for (std::uint64_t set = 0; set < size.sets(); ++set) {
                double largest = 0, error = 0;
                for (std::uint64_t i = set * coefficients; i < (set + 1) * coefficients; ++i) {
                    const double wanted = double(number_of(size, 5, l, i)) * flux[l] / unit[l];
                    largest = std::max(largest, std::abs(wanted));
                    error = std::max(error, std::abs(double(kept[i]) - wanted));
                }
                // Numbers of a few digits are rounded to whole ones.
                worst = std::max(worst, (error - 0.5) / (largest + 1e-9));
            }
            CHECK(worst <= kMaxError);
            CHECK(worst > kMaxError / 16);  // no more digits than are paid for
            for (std::uint64_t i = size.numbers() - 2; i < size.numbers(); ++i)
                CHECK(std::abs(double(kept[i]) -
                               double(number_of(size, 5, l, i)) * flux[l] / unit[l]) <= 0.5 + 1e-9);
        }
    }
}

TEST_CASE("ring sum: few digits of a flux that is a power of two are kept as they are") {
    for (const std::int64_t v : {0, 1, -1, 2047, -2047, 1024}) {
        std::int64_t sums[2] = {v, -v / 2};
        std::uint8_t packed[4] = {};
        PackParams k;
        k.numbers = 2;
        PackBuffers b;
        b.sums = sums;
        b.packed = packed;
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
            sums[0] = v, sums[1] = -v / 2;
            table->pack_sets(k, b, 0, 1);
            std::int32_t q[2];
            CHECK(unpack_set<0>(packed, 2, q) == 0);
            CHECK(q[0] == v);
            CHECK(q[1] == -v / 2);
        }
    }
}

TEST_CASE("ring sum: the longest numbers, and every instruction set alike") {
    constexpr std::uint64_t kSets = 40;
    for (const std::int32_t numbers : {16, 24, 25, 7}) {
        std::vector<std::uint8_t> first;
        std::vector<std::int64_t> first_total;
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
            const std::uint64_t count = kSets * std::uint64_t(numbers);
            std::vector<std::int64_t> sums(count), total(count, 5);
            for (std::uint64_t j = 0; j < count; ++j) {
                const std::uint64_t drawn = (j + 1) * 0x9e3779b97f4a7c15ull;
                sums[j] = std::int64_t(drawn) >> (1 + j / std::uint64_t(numbers) * 3 / 2);
            }
            std::vector<std::uint8_t> packed(kSets * packed_bytes(std::uint64_t(numbers)));
            PackParams k;
            k.numbers = numbers;
            k.scale = 0.6180339887498949;
            k.coarser = 9;
            PackBuffers b;
            b.sums = sums.data();
            b.packed = packed.data();
            b.total = total.data();
            table->pack_sets(k, b, 0, kSets);
            table->add_sets(k, b, 0, kSets);
            if (i == 0) first = packed, first_total = total;
            CAPTURE(table->name);
            CHECK(packed == first);
            CHECK(total == first_total);
        }
    }
}

TEST_CASE("ring sum: the first generations of one flux are a still picture's, to the bit") {
    for (const bool moves : {false, true}) {
        Ring ring;
        open_ring(ring);
        REQUIRE(begin_ring(ring.work, true, ring.photons, ring.sum));
        const auto flux = [&](std::uint64_t g) { return moves && g == 2 ? 0.31 : 0.3; };
        for (std::uint64_t g = 0; g < kSlots; ++g) {
            shoot(ring, g, {flux(g), 3.0}, g);
            REQUIRE(sum_ring(ring.work, g, ring.photons, ring.sum));
            const bool still = !moves || g < 2;
            CHECK(ring.sum.exact == still);
            if (!still) {
                check_same(ring.sum, anew(ring, g));
                continue;
            }
            CHECK(ring.sum.unit == std::vector<double>{0.3, 3.0});
            bool same = true;
            for (std::size_t l = 0; l < kShining; ++l)
                for (std::uint64_t i = 0; i < kSize.numbers(); ++i) {
                    std::int64_t all = 0;
                    for (std::uint64_t h = 0; h <= g; ++h) all += number_of(kSize, h, l, i);
                    same &= ring.sum.sum.sums[l * kSize.numbers() + i] == all;
                }
            CHECK(same);
        }
        // The first that gives way takes the ring to packed numbers.
        shoot(ring, kSlots, {0.3, 3.0}, 0);
        REQUIRE(sum_ring(ring.work, 0, ring.photons, ring.sum));
        CHECK(!ring.sum.exact);
        check_same(ring.sum, anew(ring, 0));
    }
}

TEST_CASE("ring sum: slots of other fluxes keep their power to half a unit each") {
    Ring ring;
    open_ring(ring);
    const double fluxes[kSlots] = {0.011, 0.3, 15.9, 4};
    for (std::uint64_t g = 0; g < kSlots; ++g) shoot(ring, g, {fluxes[g], 3}, g);
    const RingSum sum = anew(ring, 0);
    CHECK(sum.unit == std::vector<double>{16, 4});
    std::vector<double> power(kSize.numbers());
    for (const PhotonSlot& slot : ring.photons.slots) {
        const std::vector<std::int64_t> own = numbers_of(slot, 0);
        for (std::size_t i = 0; i < own.size(); ++i)
            power[i] += double(own[i]) * slot.flux_per_photon_m2[0];
    }
    bool close = true;
    for (std::size_t i = 0; i < power.size(); ++i)
        close &= std::abs(double(sum.sum.sums[i]) * 16 - power[i]) <=
                 0.5 * 16 * kSlots + 1e-14 * std::abs(power[i]);
    CHECK(close);
}

TEST_CASE("ring sum: a generation that ended within is gone") {
    Ring ring;
    open_ring(ring);
    for (std::uint64_t g = 0; g < kSlots; ++g) shoot(ring, g, {0.3, 3.0}, g);
    REQUIRE(sum_ring(ring.work, 3, ring.photons, ring.sum));
    // One of its two lights has been packed.
    const RingShot shot = begin_shot(1, false, {0.3, 3.0}, ring.photons, ring.sum);
    scatter(ring, 9, 0);
    pack_light(ring.work, 0, shot, ring.scratch, ring.photons, ring.sum);
    ++ring.photons.slots[1].serial;
    drop_shot(shot, 2, ring.photons, ring.sum);
    REQUIRE(sum_ring(ring.work, 3, ring.photons, ring.sum));
    CHECK(ring.sum.sum.generations == kSlots - 1);
    std::vector<std::int64_t> all(kSize.numbers());
    for (const std::size_t s : {0u, 2u, 3u}) {
        const std::vector<std::int64_t> own = numbers_of(ring.photons.slots[s], 0);
        for (std::size_t i = 0; i < own.size(); ++i) all[i] += own[i];
    }
    bool same = true;
    for (std::size_t i = 0; i < all.size(); ++i) same &= ring.sum.sum.sums[i] == all[i];
    CHECK(same);
    // It is shot once more, whole.
    shoot(ring, 9, {0.3, 3.0}, 1);
    REQUIRE(sum_ring(ring.work, 1, ring.photons, ring.sum));
    check_same(ring.sum, anew(ring, 1));
}

TEST_CASE("ring sum: slots that changed by themselves are counted anew") {
    Ring ring;
    open_ring(ring);
    for (std::uint64_t g = 0; g < kSlots; ++g) shoot(ring, g, {0.3, 3.0}, g);
    REQUIRE(sum_ring(ring.work, 0, ring.photons, ring.sum));
    RingSum other;  // does not see the sum that follows
    shoot(ring, 8, {0.3, 3.0}, 0);
    std::swap(other, ring.sum);
    shoot(ring, 9, {0.3, 3.0}, 2);
    std::swap(other, ring.sum);
    REQUIRE(sum_ring(ring.work, 2, ring.photons, ring.sum));
    check_same(ring.sum, anew(ring, 2));
}
