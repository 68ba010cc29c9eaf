// SPDX-License-Identifier: Apache-2.0
// The light of a whole ring of generations as one slot, kept up to date by differences.
// in: slots of a ring -> out: their sum, exact in whole numbers whatever came and went before.
// docs/collectors.md, "The ring of generations"
#pragma once
#include "src/photons/trace.h"

namespace pileus {

namespace arrays {

/// Its numbers are a slot's.
inline Array<std::int64_t> ring_sum(const SlotSize& size, std::uint64_t lights) {
    return renamed(photon_slot(size, lights), "photon map of the ring", Stage::kPhotons,
                   Stage::kWrite);
}

}  // namespace arrays

/// Each slot has a flux per photon of its own. Where it is the same in all, as under a sun that
/// stands, their whole numbers are added up. Else all are brought to one unit, a power of 16 above
/// the brightest slot's, and rounded to whole numbers slot by slot. So a slot is taken out by the
/// very numbers that it brought, and the sum is a function of what the ring holds.
struct RingSum {
    PhotonSlot sum;  ///< generations: those of all slots; sun_travel: the newest
    std::vector<std::uint64_t> counted;  ///< per slot, its `serial` when it was added; 0: it is not
    std::vector<double> unit;            ///< per light, m^2 per photon; 0: it is dark
};

/// Before slot `s` changes: what it brought leaves the sum.
void take_out(std::size_t s, int threads, Photons& photons, RingSum& ring);

/// Adds what is new in the slots; `newest` of them gives the sun. Slots are added in any order to
/// the same bits. kLimit: out of memory.
Status sum_ring(const SlotSize& size, std::size_t lights, std::size_t newest, int threads,
                Photons& photons, RingSum& ring);

}  // namespace pileus
