// SPDX-License-Identifier: Apache-2.0
// What a collectors run tells: energy, counters, digests per stage.
// in: CollectorsRun -> out: Report.
// docs/report.md.
#include "kernels_cpu/core/profile.h"
#include "src/base/digest.h"
#include "src/methods/collectors/collectors.h"
#include "src/photons/photon_report.h"

namespace pileus {
namespace {

std::string leaf_digest(const CollectorsRun& run) {
    Digest d;
    for (const Leaf& leaf : run.prepared.leaves.span()) {
        const std::int32_t faces[] = {leaf.lo[0], leaf.hi[0], leaf.lo[1],
                                      leaf.hi[1], leaf.lo[2], leaf.hi[2]};
        d.words({faces, 6});
    }
    return d.hex();
}

std::string collector_digest(const CollectorsRun& run) {
    Digest d;
    for (const Collector& c : run.prepared.collectors.span()) {
        const float numbers[] = {c.centre[0], c.centre[1], c.centre[2], c.billboard_radius,
                                 c.extinction};
        d.floats({numbers, 5});
    }
    return d.hex();
}

/// Numbers that the photon map holds for each collector.
std::uint64_t coefficients_of(const CollectorsRun& run) {
    return std::uint64_t(run.deposit.channels) * std::uint64_t(run.deposit.coefficients) *
           run.lighting.lights.size() * run.photons.slots.size();
}

}  // namespace

void collectors_digest_prepared(CollectorsRun& run) {
    run.digests = {{"density", density_digest(*run.world)},
                   {"leaves", leaf_digest(run)},
                   {"collectors", collector_digest(run)}};
}

void collectors_count(const CollectorsRun& run, Counts& counters) {
    count_photons(run, counters);
    counters.emplace_back("samples_given_up", run.prepared.rejected);
}

void collectors_report(const CollectorsRun& run, Report& report) {
    report.prepared.samples = run.prepared.samples;
    report.prepared.leaves = run.prepared.leaves.size();
    report.prepared.collectors = run.prepared.collectors.size();
    report_photons(run, report);
    report.executed.emplace_back("coefficients", coefficients_of(run));
    if (run.digests.empty()) return;
    report.digests.insert(report.digests.begin(), {"photons", photon_digest(run.photons)});
    report.digests.insert(report.digests.begin(), run.digests.begin(), run.digests.end());
}

}  // namespace pileus
