// SPDX-License-Identifier: Apache-2.0
// See photon_report.h: what flights have of it, counts and the bounds of sums.
// in: tallies, photons -> out: counts; kLimit where a sum could overflow.
// docs/report.md.
#include "src/photons/photon_report.h"

namespace pileus {
namespace {

/// Photons that a fate stands for, in the channel that has most of it.
std::uint64_t photons_in(const std::int64_t (&fate)[3]) {
    std::int64_t most = 0;
    for (const std::int64_t quanta : fate) most = quanta > most ? quanta : most;
    return std::uint64_t((most + kPhotonQuanta - 1) / kPhotonQuanta);
}

}  // namespace

TraceTally tally_of(const PhotonRing& ring) {
    TraceTally all{};
    for (const TraceTally& tally : ring.photons.tallies) add_tally(tally, all);
    return all;
}

void count_photons(const PhotonRing& ring, Counts& counters) {
    const TraceTally all = tally_of(ring);
    counters.emplace_back("majorant_violations", std::uint64_t(all.majorant_violations));
    counters.emplace_back("saturated", 0);  // fixed_point_places proves it
    counters.emplace_back("terminated", photons_in(all.light.terminated));
}

void bound_ledgers(double photons, double max_events, Plan& plan) {
    plan.bounds.resize(1);
    // A photon may die twice, the second time as the ground's missing light.
    SumBound ledger[] = {deposit_bound("energy of a fate", 2 * photons, 1, 20),
                         deposit_bound("path of all photons", 2 * photons, 2147483520.0, 0),
                         deposit_bound("scatterings", photons * max_events, 1, 0)};
    for (SumBound& bound : ledger) {
        bound.allowed = 0x1p63;
        plan.bounds.push_back(bound);
    }
}

Status check_bounds(const Plan& plan, const std::string& file, const char* key) {
    for (const SumBound& bound : plan.bounds)
        if (!(bound.worst < bound.allowed))
            return Status::limit(file + ": " + key + ": the sum \"" + bound.sum +
                                 "\" could overflow 64 bits; take fewer");
    return Status::ok();
}

std::uint64_t photons_of_run(const PhotonState& state, const Context& context) {
    std::uint64_t generation = 0;
    for (const Light& light : state.lights.lighting.lights) generation += light.photons;
    return bytes_of(generation, state.ring.generations + context.frames - 1);
}

}  // namespace pileus
