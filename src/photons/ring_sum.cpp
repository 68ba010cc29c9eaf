// SPDX-License-Identifier: Apache-2.0
// See ring_sum.h.
#include "src/photons/ring_sum.h"

#include "platform/threads.h"

namespace pileus {
namespace {

/// So coarse that a sun that climbs seldom changes the unit.
constexpr double kCoarse = 16;

double flux_of(const PhotonSlot& slot, std::size_t light) {
    if (slot.generations == 0 || !(slot.generations_of(light) > 0)) return 0;
    return slot.flux_per_photon_m2[light] > 0 ? slot.flux_per_photon_m2[light] : 0;
}

/// One unit for a light's numbers in all slots.
double unit_of(const Photons& photons, std::size_t light) {
    double most = 0, least = 0;
    for (const PhotonSlot& slot : photons.slots) {
        const double flux = flux_of(slot, light);
        if (!(flux > 0)) continue;
        most = flux > most ? flux : most;
        least = !(least > 0) || flux < least ? flux : least;
    }
    if (!(most > least)) return most;
    // Products and quotients by powers of two are exact.
    double unit = 1;
    while (unit < most) unit *= kCoarse;
    while (unit / kCoarse >= most) unit /= kCoarse;
    return unit;
}

/// Adds a slot's numbers in the sum's units, or takes them out again.
void add_slot(const PhotonSlot& slot, std::int64_t sign, int threads, RingSum& ring) {
    const std::size_t lights = ring.unit.size(), stride = slot.sums.size() / lights;
    constexpr std::size_t kPiece = 1u << 14;
    const std::size_t pieces = (stride + kPiece - 1) / kPiece;
    for (std::size_t l = 0; l < lights; ++l) {
        const double flux = flux_of(slot, l);
        if (!(flux > 0)) continue;
        // At most 1, so that the sum is below the bound on all photons of the ring.
        const double factor =
            flux / ring.unit[l] * (double(slot.generations) / slot.generations_of(l));
        const std::int64_t* from = slot.sums.data() + l * stride;
        std::int64_t* to = ring.sum.sums.data() + l * stride;
        parallel_for(threads, std::int64_t(pieces), [&](std::int64_t piece, int) {
            const std::size_t begin = std::size_t(piece) * kPiece;
            const std::size_t end = begin + kPiece < stride ? begin + kPiece : stride;
            for (std::size_t i = begin; i < end && factor == 1; ++i) to[i] += sign * from[i];
            for (std::size_t i = begin; i < end && factor != 1; ++i) {
                const double v = double(from[i]) * factor;
                to[i] += sign * std::int64_t(v < 0 ? v - 0.5 : v + 0.5);
            }
        });
    }
    ring.sum.generations += std::uint64_t(sign) * slot.generations;
    ring.sum.scatterings += sign * slot.scatterings;
}

/// Whether what was counted is still what its slots hold.
bool is_sound(const Photons& photons, const RingSum& ring) {
    for (std::size_t s = 0; s < ring.counted.size(); ++s)
        if (ring.counted[s] != 0 && ring.counted[s] != photons.slots[s].serial) return false;
    return true;
}

}  // namespace

void take_out(std::size_t s, int threads, Photons& photons, RingSum& ring) {
    if (s >= ring.counted.size() || ring.counted[s] == 0) return;
    if (ring.counted[s] == photons.slots[s].serial) add_slot(photons.slots[s], -1, threads, ring);
    ring.counted[s] = 0;
}

Status sum_ring(const SlotSize& size, std::size_t lights, std::size_t newest, int threads,
                Photons& photons, RingSum& ring) {
    const auto sums = arrays::ring_sum(size, lights);
    std::vector<double> unit;
    for (std::size_t l = 0; l < lights; ++l) unit.push_back(unit_of(photons, l));
    if (ring.sum.sums.size() != sums.count || ring.unit != unit ||
        ring.counted.size() != photons.slots.size() || !is_sound(photons, ring)) {
        PILEUS_TRY(allocate_once(sums, ring.sum.sums));
        empty_slot(ring.sum, threads);
        ring.unit = unit;
        ring.counted.assign(photons.slots.size(), 0);
    }
    for (std::size_t s = 0; s < photons.slots.size(); ++s) {
        const PhotonSlot& slot = photons.slots[s];
        if (ring.counted[s] != 0 || slot.generations == 0) continue;
        add_slot(slot, 1, threads, ring);
        ring.counted[s] = slot.serial;
    }
    ring.sum.flux_per_photon_m2 = ring.unit;
    ring.sum.sun_travel = photons.slots[newest].sun_travel;
    return Status::ok();
}

}  // namespace pileus
