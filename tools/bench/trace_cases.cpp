// SPDX-License-Identifier: Apache-2.0
// Photon tracing: one generation per iteration, by scene, tracking, instruction set and threads.
// in: prepared scenes -> out: ns of CPU per scattering, rates, and the ratio to the floor.
// docs: README.md in this folder; rates are per CPU second, which is per core.
#include <algorithm>

#include "platform/clock.h"
#include "tools/bench/bench.h"
#include "tools/bench/floor.h"

namespace bench {
namespace {

using namespace pileus;

struct TraceCase {
    std::string name, scene;
    Overrides overrides;
    bool deposits = true;
};

/// One generation; without deposits its ledger alone, so that their share of the time shows.
Status shoot(const Context& context, ReadyScene& p, bool deposits) {
    if (deposits) return p.shoot(context);
    TraceInput in = p.method->trace_input(context, p.view());
    in.deposit.mode = kDepositNone;
    PhotonRing& ring = p.state().ring;
    return trace_generation(in, 0, ring.scratch, ring.photons.slots[0], ring.photons.tallies);
}

TraceTally total_of(ReadyScene& p) {
    TraceTally total{};
    for (const TraceTally& t : p.state().ring.photons.tallies) add_tally(t, total);
    return total;
}

FloorWork floor_work(ReadyScene& p) {
    const TraceTally t = total_of(p);
    const Buffer<float>& density = p.world().medium.volume.density;
    const Buffer<float>& majorants = p.state().majorants.tracking;
    FloorWork work{};
    work.tentative = std::uint32_t(t.tentative);
    work.scatterings = std::uint32_t(t.scatterings);
    work.crossings = std::uint32_t(t.crossings);
    work.voxels = std::uint32_t(density.size());
    work.blocks = std::uint32_t(majorants.size());
    work.density = density.data();
    work.majorant = majorants.data();
    work.collector = p.state().prepared.collector_of_voxel.data();
    return work;
}

constexpr auto kRate = benchmark::Counter::kIsRate;
const auto kTimeEach = benchmark::Counter::kIsRate | benchmark::Counter::kInvert;

void count(benchmark::State& state, const TraceTally& t, double floor_ratio) {
    const double n = double(state.iterations());
    state.counters["photons/s"] = benchmark::Counter(n * double(t.photons), kRate);
    state.counters["scatterings/s"] = benchmark::Counter(n * double(t.scatterings), kRate);
    state.counters["tentative/s"] = benchmark::Counter(n * double(t.tentative), kRate);
    state.counters["s/scattering"] = benchmark::Counter(n * double(t.scatterings), kTimeEach);
    state.counters["tentative/scattering"] = double(t.tentative) / double(t.scatterings);
    state.counters["crossings/scattering"] = double(t.crossings) / double(t.scatterings);
    state.counters["times_floor"] = floor_ratio;
}

/// Fastest of five, CPU seconds.
double floor_seconds(Bench& bench, benchmark::State& state, const TraceCase& which,
                     FloorKernel floor, const FloorWork& work) {
    double best = 1e30;
    for (int i = 0; i < 5; ++i) {
        const double start = cpu_seconds();
        bench.check(state, "floor of " + which.name, floor(work));
        best = std::min(best, cpu_seconds() - start);
    }
    return best;
}

void run_trace(benchmark::State& state, Bench& bench, const TraceCase& which,
               const KernelTable* kernels, int threads) {
    ReadyScene* p = bench.prepared(state, which.scene, which.overrides);
    if (p == nullptr) return;
    const Context context = with(p->context, kernels, threads);
    double fastest = 1e30;
    for (auto _ : state) {
        state.PauseTiming();
        forget_photons(p->state());
        state.ResumeTiming();
        const double start = cpu_seconds();
        const Status status = shoot(context, *p, which.deposits);
        fastest = std::min(fastest, cpu_seconds() - start);
        state.PauseTiming();
        if (!bench.passed(state, status)) return;
        bench.check(state, which.name, photon_digest(p->state().ring));
        state.ResumeTiming();
    }
    // Both sides of the ratio are the fastest of several, one after the other.
    const FloorKernel floor = floor_kernel(kernels->name);
    double ratio = 0;
    if (floor != nullptr)
        ratio = fastest / floor_seconds(bench, state, which, floor, floor_work(*p));
    count(state, total_of(*p), ratio);
}

void run_floor(benchmark::State& state, Bench& bench, const TraceCase& which,
               const KernelTable* kernels) {
    ReadyScene* p = bench.prepared(state, which.scene, which.overrides);
    const FloorKernel floor = floor_kernel(kernels->name);
    if (p == nullptr || floor == nullptr) return;
    forget_photons(p->state());
    if (!bench.passed(state, shoot(p->context, *p, which.deposits))) return;
    const FloorWork work = floor_work(*p);
    for (auto _ : state) bench.check(state, "floor of " + which.name, floor(work));
    count(state, total_of(*p), 1);
}

}  // namespace

void register_trace_cases(Bench& bench) {
    // A fiftieth of the photons per iteration, as one generation of the default ring.
    const std::string few = "collectors.generations=50";
    // The same cloud as two media of half the extinction and a lobe each: what mixing costs.
    const Overrides halves = {few,
                              "medium.0.extinction_per_m=0.025",
                              "medium.1.density=procedural:cumulus",
                              "medium.1.bounds_m=[[-800,-800,600],[800,800,1700]]",
                              "medium.1.resolution=[160,160,110]",
                              "medium.1.extinction_per_m=0.025",
                              "medium.1.phase={type=\"henyey-greenstein\",g=0.5}"};
    const Overrides global = {few, "collectors.tracking=global"};
    // And as one medium of these two lobes: the same light, without mixing.
    const Overrides lobes = {few, "medium.0.phase={type=\"two-lobe\",g1=0.85,g2=0.5,weight=0.5}"};
    const TraceCase cases[] = {
        {"trace/slab", "slab", {few, "collectors.photons=1000000"}},
        {"trace/cumulus128/local", "../studies/scenes/cumulus128", {few}},
        {"trace/cumulus128/global", "../studies/scenes/cumulus128", global},
        {"trace/cumulus128/bare", "../studies/scenes/cumulus128", {few}, false},
        {"trace/cumulus/local", "cumulus", {few, "collectors.tracking=local"}},
        {"trace/cumulus/global", "cumulus", {few, "collectors.tracking=global"}},
        {"trace/cumulus/two_media", "cumulus", halves},
        {"trace/cumulus/two_lobes", "cumulus", lobes},
    };
    for (const TraceCase& which : cases)
        for_each_machine([&](const std::string& suffix, const KernelTable* kernels, int threads) {
            benchmark::RegisterBenchmark((which.name + suffix).c_str(),
                                         [&bench, which, kernels, threads](benchmark::State& s) {
                                             run_trace(s, bench, which, kernels, threads);
                                         })
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
            if (threads > 1) return;
            benchmark::RegisterBenchmark(("floor/" + which.name + suffix).c_str(),
                                         [&bench, which, kernels](benchmark::State& s) {
                                             run_floor(s, bench, which, kernels);
                                         })
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
        });
}

}  // namespace bench
