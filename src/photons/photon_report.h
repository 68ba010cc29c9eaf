// SPDX-License-Identifier: Apache-2.0
// What every run of photons tells: the energy ledger, counts, the digest and bounds of its sums.
// in: PhotonRun -> out: Report, Plan.
// docs/report.md.
#pragma once
#include "src/photons/photon_run.h"

namespace pileus {

/// Digests the slots whose sums have changed: of a ring one in each frame.
void digest_photons(int threads, Photons& photons);

/// Of the digests of all slots.
std::string photon_digest(const Photons& photons);

void count_photons(const PhotonRun& run, Counts& counters);

/// Fills generations, energy and events.
void report_photons(const PhotonRun& run, Report& report);

/// Adds the bounds of the sums that no picture shows but every report does, behind the first one.
void bound_ledgers(double photons, double max_events, Plan& plan);

/// kLimit where a bound of the plan is broken; `key` says how many photons were asked for.
Status check_bounds(const Plan& plan, const std::string& file, const char* key);

/// The ring, and one generation for each further picture.
std::uint64_t photons_of_run(const PhotonRun& run, const Context& context);

}  // namespace pileus
