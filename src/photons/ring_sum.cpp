// SPDX-License-Identifier: Apache-2.0
// See ring_sum.h.
#include "src/photons/ring_sum.h"

#include "platform/threads.h"

namespace pileus {
namespace {

/// Sets that one thread takes at a time: the numbers of a few stay in its cache.
constexpr std::uint64_t kSets = 1024;

/// The power of two at or above a positive number.
double power_above(double flux) {
    double unit = 1;
    while (unit < flux) unit *= 2;
    while (unit / 2 >= flux) unit /= 2;
    return unit;
}

/// How often `small` has to be doubled to be `large`, both powers of two; far ones are alike.
int doublings(double small, double large) {
    int n = 0;
    for (; small > 0 && small < large && n < 64; ++n) small *= 2;
    return n;
}

double unit_in(const PhotonSlot& slot, std::size_t light) {
    return slot.generations > 0 ? slot.flux_per_photon_m2[light] : 0;
}

/// The largest unit of a light's numbers in all slots but one.
double unit_beside(const Photons& photons, std::size_t light, std::size_t but) {
    double most = 0;
    for (std::size_t s = 0; s < photons.slots.size(); ++s) {
        const double unit = s == but ? 0 : unit_in(photons.slots[s], light);
        most = unit > most ? unit : most;
    }
    return most;
}

/// The table that packs; beside a device it is the host's.
const KernelTable& packing_kernels(const RingWork& work) { return host_kernels(work.kernels); }

/// A number of the ground in units of 2^coarser, halves away from zero.
std::int64_t in_units(std::int64_t v, int coarser) {
    if (coarser == 0) return v;
    if (coarser > 62) return 0;
    const std::uint64_t size = v < 0 ? 0 - std::uint64_t(v) : std::uint64_t(v);
    const auto whole = std::int64_t((size + (std::uint64_t{1} << (coarser - 1))) >> coarser);
    return v < 0 ? -whole : whole;
}

std::int64_t rounded(double v) { return std::int64_t(v < 0 ? v - 0.5 : v + 0.5); }

/// Of a light in the sum: [set][number], then [ground cell][channel].
std::int64_t* total_of(const PhotonSlot& slot, std::size_t light, RingSum& ring) {
    return ring.sum.sums.data() + light * (ring.sum.sums.size() / slot.packed.lights);
}

/// Adds pieces of a slot to the sum.
void add_sets(const KernelTable& kernels, std::size_t light, std::uint64_t begin, std::uint64_t end,
              PhotonSlot& slot, RingSum& ring) {
    PackedSums& packed = slot.packed;
    const double unit = unit_in(slot, light);
    if (!(unit > 0)) return;
    PackParams k;
    k.numbers = std::int32_t(packed.numbers);
    k.coarser = doublings(unit, ring.unit[light]);
    PackBuffers b;
    b.packed = packed.of_light(light);
    b.total = total_of(slot, light, ring);
    kernels.add_sets(k, b, begin, end);
    if (end < packed.count) return;
    std::int64_t* to = b.total + packed.count * packed.numbers;
    const std::size_t cells = packed.ground.size() / packed.lights;
    const std::int64_t* from = packed.ground.data() + light * cells;
    for (std::size_t i = 0; i < cells; ++i) to[i] += in_units(from[i], k.coarser);
}

/// Whether what was counted is still what its slots hold, in the sum's units.
bool is_sound(const Photons& photons, const RingSum& ring) {
    if (ring.counted.size() != photons.slots.size()) return false;
    for (std::size_t s = 0; s < ring.counted.size(); ++s)
        if (ring.counted[s] != 0 && ring.counted[s] != photons.slots[s].serial) return false;
    if (ring.exact) return true;
    for (std::size_t l = 0; l < ring.unit.size(); ++l)
        if (ring.unit[l] != unit_beside(photons, l, photons.slots.size())) return false;
    return true;
}

void count_slot(const PhotonSlot& slot, std::int64_t sign, RingSum& ring) {
    ring.sum.generations += std::uint64_t(sign) * slot.generations;
    ring.sum.scatterings += sign * slot.scatterings;
}

/// Adds slots to the sum, pieces of which stay in the cache meanwhile.
void add_slots(const RingWork& work, const std::vector<std::size_t>& slots, Photons& photons,
               RingSum& ring) {
    const PackedSums& packed = photons.slots[0].packed;
    const std::uint64_t pieces = packed.count / kSets + 1;
    parallel_for(work.threads, std::int64_t(pieces * packed.lights), [&](std::int64_t piece, int) {
        const std::uint64_t begin = std::uint64_t(piece) % pieces * kSets;
        const std::uint64_t end = begin + kSets < packed.count ? begin + kSets : packed.count;
        for (const std::size_t s : slots)
            add_sets(packing_kernels(work), std::size_t(std::uint64_t(piece) / pieces), begin, end,
                     photons.slots[s], ring);
    });
    for (const std::size_t s : slots) count_slot(photons.slots[s], 1, ring);
}

/// The ground's numbers of a light: those of all threads, in the slot's unit.
void pack_ground(std::size_t light, const PackParams& k, const PackBuffers& b, PackedSums& packed) {
    const std::size_t cells = packed.ground.size() / packed.lights;
    std::int64_t* ground = packed.ground.data() + light * cells;
    const std::uint64_t first = packed.count * packed.numbers;
    for (std::size_t i = 0; i < cells; ++i) {
        std::int64_t all = 0;
        for (std::int32_t t = 0; t < k.blocks; ++t) {
            std::int64_t& own = b.sums[std::uint64_t(t) * k.block_stride + first + i];
            all += own;
            own = 0;
        }
        const std::int64_t was = k.replaces ? in_units(ground[i], k.old_coarser) : 0;
        ground[i] = rounded(double(all) * k.scale);
        if (b.total == nullptr) continue;
        b.total[first + i] += k.exact ? all : in_units(ground[i], k.coarser) - was;
    }
}

void forget(RingSum& ring) {
    ring.counted.clear();
    ring.exact = false;
}

/// Whether the sum with that generation in place of what its slot holds has the same unit.
bool follows(const RingShot& shot, const Photons& photons, RingSum& ring) {
    if (ring.exact) {
        if (ring.sum.generations == 0) ring.unit = shot.flux;
        return ring.unit == shot.flux && ring.counted[shot.number] == 0;
    }
    if (ring.unit.size() != shot.unit.size()) return false;
    for (std::size_t l = 0; l < shot.unit.size(); ++l) {
        const double others = unit_beside(photons, l, shot.number);
        if (ring.unit[l] != (shot.unit[l] > others ? shot.unit[l] : others)) return false;
    }
    return true;
}

/// A sum of nothing.
Status clear_sum(const RingWork& work, const Photons& photons, RingSum& ring) {
    const auto sums = arrays::ring_sum(work.size, photons.slots[0].packed.lights);
    PILEUS_TRY(allocate_once(sums, ring.sum.sums));
    empty_slot(ring.sum, work.threads);
    ring.counted.assign(photons.slots.size(), 0);
    return Status::ok();
}

}  // namespace

void add_slot_rows(const SlotSize& size, std::uint64_t lights, std::uint64_t slots, bool packed,
                   MemoryTable& table) {
    if (!packed) return add(table, several(slots, arrays::photon_slot(size, lights)));
    add(table, several(slots, arrays::packed_slot(size, lights)),
        several(slots, arrays::packed_ground(size, lights)));
    add(table, arrays::ring_sum(size, lights));
}

Status begin_ring(const RingWork& work, bool first, Photons& photons, RingSum& ring) {
    for (PhotonSlot& slot : photons.slots) slot.serial = 0;
    forget(ring);
    if (!first) return Status::ok();
    PILEUS_TRY(clear_sum(work, photons, ring));
    ring.exact = true;
    return Status::ok();
}

RingShot begin_shot(std::size_t number, bool first_turn, const std::vector<double>& flux,
                    Photons& photons, RingSum& ring) {
    RingShot shot;
    shot.number = number;
    shot.flux = flux;
    for (const double f : flux) shot.unit.push_back(f > 0 ? power_above(f) : 0);
    PhotonSlot& slot = photons.slots[number];
    if (!first_turn && ring.exact) forget(ring);
    shot.follows = is_sound(photons, ring) && follows(shot, photons, ring);
    if (!shot.follows) forget(ring);
    if (shot.follows && ring.counted[number] != 0) count_slot(slot, -1, ring);
    // Its numbers are in it until its lights are packed, one after the other.
    slot.flux_per_photon_m2.resize(flux.size(), 0);
    slot.generations = 0;
    slot.scatterings = 0;
    slot.parts.clear();
    return shot;
}

void pack_light(const RingWork& work, std::size_t light, const RingShot& shot,
                TraceScratch& scratch, Photons& photons, RingSum& ring) {
    PhotonSlot& slot = photons.slots[shot.number];
    PackedSums& packed = slot.packed;
    const double unit = shot.unit[light];
    PackParams k;
    k.numbers = std::int32_t(packed.numbers);
    k.blocks = scratch.blocks;
    k.block_stride = scratch.stride;
    k.scale = unit > 0 ? shot.flux[light] / unit : 0;
    PackBuffers b;
    b.sums = scratch.sums.data();
    b.packed = packed.of_light(light);
    if (shot.follows) {
        k.coarser = doublings(unit, ring.unit[light]);
        k.old_coarser = doublings(slot.flux_per_photon_m2[light], ring.unit[light]);
        k.replaces = ring.counted[shot.number] != 0;
        k.exact = ring.exact;
        b.total = total_of(slot, light, ring);
    }
    const KernelTable& kernels = packing_kernels(work);
    const std::uint64_t pieces = (packed.count + kSets - 1) / kSets;
    parallel_for(work.threads, std::int64_t(pieces), [&](std::int64_t piece, int) {
        const std::uint64_t begin = std::uint64_t(piece) * kSets;
        kernels.pack_sets(k, b, begin, begin + kSets < packed.count ? begin + kSets : packed.count);
    });
    pack_ground(light, k, b, packed);
    slot.flux_per_photon_m2[light] = unit;
}

void end_shot(const RingShot& shot, Photons& photons, RingSum& ring) {
    if (!shot.follows) return;
    const PhotonSlot& slot = photons.slots[shot.number];
    count_slot(slot, 1, ring);
    ring.counted[shot.number] = slot.serial;
}

void drop_shot(const RingShot& shot, int threads, Photons& photons, RingSum& ring) {
    // The sum has some of it.
    forget(ring);
    empty_slot(photons.slots[shot.number], threads);
}

Status sum_ring(const RingWork& work, std::size_t newest, Photons& photons, RingSum& ring) {
    const std::size_t lights = photons.slots[0].packed.lights;
    if (ring.unit.size() != lights || !is_sound(photons, ring)) {
        forget(ring);
        PILEUS_TRY(clear_sum(work, photons, ring));
        ring.unit.clear();
        for (std::size_t l = 0; l < lights; ++l)
            ring.unit.push_back(unit_beside(photons, l, photons.slots.size()));
    }
    std::vector<std::size_t> news;
    for (std::size_t s = 0; s < photons.slots.size(); ++s)
        if (ring.counted[s] == 0 && photons.slots[s].generations > 0) news.push_back(s);
    if (!news.empty()) add_slots(work, news, photons, ring);
    for (const std::size_t s : news) ring.counted[s] = photons.slots[s].serial;
    ring.sum.flux_per_photon_m2 = ring.unit;
    ring.sum.sun_travel = photons.slots[newest].sun_travel;
    return Status::ok();
}

}  // namespace pileus
