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
    for (const Leaf& leaf : run.prepared.leaves.span())
        for (int a = 0; a < 3; ++a) {
            d.u32(std::uint32_t(leaf.lo[a]));
            d.u32(std::uint32_t(leaf.hi[a]));
        }
    return d.hex();
}

std::string collector_digest(const CollectorsRun& run) {
    Digest d;
    for (const Collector& c : run.prepared.collectors.span()) {
        for (float x : c.centre) d.f32(x);
        d.f32(c.billboard_radius);
        d.f32(c.extinction);
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

void collectors_report(const CollectorsRun& run, Report& report) {
    report.samples = run.prepared.samples;
    report.leaves = run.prepared.leaves.size();
    report.collectors = run.prepared.collectors.size();
    report_photons(run, report);
    report.counters.emplace_back("samples_given_up", run.prepared.rejected);
    if (!kPlans) return;
    report.executed.emplace_back("coefficients", coefficients_of(run));
    if (run.digests.empty()) return;
    report.digests.insert(report.digests.begin(), {"photons", photon_digest(run.photons)});
    report.digests.insert(report.digests.begin(), run.digests.begin(), run.digests.end());
}

}  // namespace pileus
