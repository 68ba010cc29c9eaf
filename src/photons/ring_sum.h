// SPDX-License-Identifier: Apache-2.0
// A ring of packed generations, and the light of all of them as one slot.
// in: sums of a generation -> out: its slot; the ring's sum, exact whatever came and went before.
// docs/collectors.md, "The ring of generations"
#pragma once
#include "src/photons/trace.h"

namespace pileus {

namespace arrays {

/// Its numbers are those of a slot that is not packed.
inline Array<std::int64_t> ring_sum(const SlotSize& size, std::uint64_t lights) {
    return renamed(photon_slot(size, lights), "photon map of the ring", Stage::kPhotons,
                   Stage::kWrite);
}

}  // namespace arrays

/// Rows of `slots` slots; where they are packed also that of their sum.
void add_slot_rows(const SlotSize& size, std::uint64_t lights, std::uint64_t slots, bool packed,
                   MemoryTable& table);

/// Bytes of all threads' own sums, of which there is one at least where slots are packed from it.
inline std::uint64_t scratch_bytes(std::uint64_t private_sums, std::uint64_t set, bool packed) {
    return packed && private_sums < set ? set : private_sums;
}

/// Each slot counts in a unit of its own, the power of two at or above its flux per photon, and the
/// sum in the largest of these units. So a slot's numbers come into the sum by shifts, rounded
/// where the units differ: a slot is taken out by the very numbers that it brought, and the sum is
/// a function of what the ring holds. The first generations, all of one flux, are a still
/// picture's: while nothing else is in the ring the sum is that of their numbers before packing, in
/// their own unit.
struct RingSum {
    PhotonSlot sum;  ///< generations: those of all slots; sun_travel: the newest
    std::vector<std::uint64_t> counted;  ///< per slot, its `serial` when it was added; 0: it is not
    std::vector<double> unit;            ///< per light, m^2 per photon; 0: it is dark
    bool exact = false;                  ///< of a still picture's generations
};

/// A generation on its way into slot `number`.
struct RingShot {
    std::size_t number = 0;
    std::vector<double> flux;  ///< per light, m^2 per photon
    std::vector<double> unit;  ///< of the slot
    bool follows = false;      ///< the sum is brought up to date light by light
};

/// Who does the work, on slots of which size.
struct RingWork {
    SlotSize size;
    int threads = 1;
    const KernelTable* kernels = nullptr;
};

/// For a ring of empty slots; `first`: the next generation is the first of all. kLimit: out of
/// memory.
Status begin_ring(const RingWork& work, bool first, Photons& photons, RingSum& ring);

/// Before the generation is traced: whether the sum can follow, else it will be made anew.
/// `first_turn`: it is one of those that a still picture would have.
RingShot begin_shot(std::size_t number, bool first_turn, const std::vector<double>& flux,
                    Photons& photons, RingSum& ring);

/// Packs a light's sums from the scratch into its slot, in place of what that held, and leaves
/// zeros in the scratch.
void pack_light(const RingWork& work, std::size_t light, const RingShot& shot,
                TraceScratch& scratch, Photons& photons, RingSum& ring);

/// Once all lights are packed: the slot counts.
void end_shot(const RingShot& shot, Photons& photons, RingSum& ring);

/// The generation ended within: the slot is empty.
void drop_shot(const RingShot& shot, int threads, Photons& photons, RingSum& ring);

/// Adds what is not yet in the sum; `newest` of the slots gives the sun. Slots are added in any
/// order to the same bits. kLimit: out of memory.
Status sum_ring(const RingWork& work, std::size_t newest, Photons& photons, RingSum& ring);

}  // namespace pileus
