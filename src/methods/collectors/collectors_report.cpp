// SPDX-License-Identifier: Apache-2.0
// What a collectors run tells: energy, counters, digests per stage.
// in: CollectorsRun -> out: Report.
// docs/report.md.
#include "src/base/digest.h"
#include "src/methods/collectors/collectors.h"

namespace pileus {
namespace {

/// Binomial standard error of a share of n photons (fates are exclusive outcomes of each).
double share_error(double share, double n) {
    return n > 1 && share > 0 && share < 1 ? __builtin_sqrt(share * (1 - share) / (n - 1)) : 0;
}

EnergyRow energy_row(const std::string& light, const Fates& f) {
    EnergyRow row;
    // The first colour channel in which the light shines.
    std::size_t c = 0;
    while (c < 2 && f.emitted[c] == 0) ++c;
    row.light = light;
    row.balance_quanta = f.emitted[c] - f.top[c] - f.bottom[c] - f.sides[c] - f.absorbed[c] -
                         f.ground[c] - f.sky[c] - f.terminated[c] - f.solid[c];
    const double unit = double(f.emitted[c]);
    if (unit <= 0) return row;
    // A photon that carries a share of its power counts as that share: its variance is less yet.
    const double photons = unit / double(kPhotonQuanta);
    row.emitted = 1;
    row.top = double(f.top[c]) / unit;
    row.bottom = double(f.bottom[c]) / unit;
    row.sides = double(f.sides[c]) / unit;
    row.absorbed = double(f.absorbed[c]) / unit;
    row.ground = double(f.ground[c]) / unit;
    row.sky = double(f.sky[c]) / unit;
    row.solid = double(f.solid[c]) / unit;
    row.terminated = double(f.terminated[c]) / unit;
    row.direct_bottom = double(f.direct_bottom[c]) / unit;
    row.top_error = share_error(row.top, photons);
    row.bottom_error = share_error(row.bottom, photons);
    row.sides_error = share_error(row.sides, photons);
    row.absorbed_error = share_error(row.absorbed, photons);
    return row;
}

/// Photons that a fate stands for, in the channel that has most of it.
std::uint64_t photons_in(const std::int64_t (&fate)[3]) {
    std::int64_t most = 0;
    for (const std::int64_t quanta : fate) most = quanta > most ? quanta : most;
    return std::uint64_t((most + kPhotonQuanta - 1) / kPhotonQuanta);
}

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

std::string photon_digest(const CollectorsRun& run) {
    Digest d;
    for (const PhotonSlot& slot : run.photons.slots) d.integers(slot.sums.span());
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
    report.generations = run.next_generation;
    report.interrupted = run.interrupted;
    report.ring_generations = report.ring_whole = 0;
    if (run.scene->animation.present && run.photons.slots.size() == run.generations) {
        report.ring_whole = run.generations;
        for (const PhotonSlot& slot : run.photons.slots)
            report.ring_generations += slot.generations > 0 ? 1 : 0;
    }
    report.energy.clear();
    TraceTally all{};
    for (std::size_t l = 0; l < run.photons.tallies.size(); ++l) {
        const TraceTally& t = run.photons.tallies[l];
        add_tally(t, all);
        report.energy.push_back(energy_row(run.lighting.lights[l].name, t.light));
        if (t.shadow.emitted[0] > 0)
            report.energy.push_back(
                energy_row(run.lighting.lights[l].name + ": kept from the ground", t.shadow));
    }
    report.photons = std::uint64_t(all.photons);
    report.scatterings = std::uint64_t(all.scatterings);
    report.tentative = std::uint64_t(all.tentative);
    report.crossings = std::uint64_t(all.crossings);
    double diagonal = 0;
    for (double e : run.world->medium.extent_m) diagonal += e * e;
    if (all.photons > 0)
        report.mean_path_m =
            double(all.path) / 1048576.0 * __builtin_sqrt(diagonal) / double(all.photons);
    report.executed.emplace_back("absorption_tests", std::uint64_t(all.absorption_tests));
    report.executed.emplace_back("ground_bounces", std::uint64_t(all.bounces));
    report.executed.emplace_back("coefficients", coefficients_of(run));
    report.counters.emplace_back("majorant_violations", std::uint64_t(all.majorant_violations));
    report.counters.emplace_back("saturated", 0);  // fixed_point_places proves it
    report.counters.emplace_back("terminated", photons_in(all.light.terminated));
    report.counters.emplace_back("samples_given_up", run.prepared.rejected);
    if (run.digests.empty()) return;
    report.digests.insert(report.digests.begin(), {"photons", photon_digest(run)});
    report.digests.insert(report.digests.begin(), run.digests.begin(), run.digests.end());
}

}  // namespace pileus
