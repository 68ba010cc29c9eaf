// SPDX-License-Identifier: Apache-2.0
// How costs grow: one case per size, each the fastest of three on one thread.
// in: scenes that differ in one number -> out: that number as x, the cost as y.
// docs: README.md in this folder; tools/bench/report fits a straight line through the logarithms.
#include <algorithm>
#include <cstdio>

#include "platform/clock.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

/// What grows, and what of it is measured.
struct GrowthCase {
    enum Kind { kTrace, kTracePerScattering, kPrepare, kFrame } kind;
    std::string name;  ///< growth/WHAT/AXIS/SIZE
    double x;          ///< 0: the number of collectors
    Overrides overrides;
};

constexpr int kTurns = 3;

/// Seconds of the fastest of three generations from the start.
double trace_seconds(benchmark::State& state, Bench& bench, const GrowthCase& which,
                     const Context& context, ReadyScene& p) {
    double best = 1e30;
    for (int i = 0; i < kTurns; ++i) {
        forget_photons(p.state());
        const double start = cpu_seconds();
        if (!bench.passed(state, p.shoot(context))) return 0;
        best = std::min(best, cpu_seconds() - start);
        bench.check(state, which.name, photon_digest(p.state().ring));
    }
    return best;
}

double prepare_seconds(benchmark::State& state, Bench& bench, const GrowthCase& which,
                       const Context& context, const ReadyScene& scene) {
    double best = 1e30;
    for (int i = 0; i < kTurns; ++i) {
        const double start = cpu_seconds();
        pileus::Prepared out;
        pileus::Majorants majorants;
        if (!bench.passed(state,
                          prepare_collectors(scene.scenery.world->medium, scene.scene.collectors,
                                             scene.scene.seed, context, out)) ||
            !bench.passed(state,
                          make_majorants(scene.scenery.world->medium, true, context, majorants)))
            return 0;
        best = std::min(best, cpu_seconds() - start);
        bench.check(state, which.name, prepared_digest(out, majorants));
    }
    return best;
}

double frame_seconds(benchmark::State& state, Bench& bench, const GrowthCase& which,
                     Context context, ReadyScene& p) {
    if (!bench.passed(state, p.shoot(context))) return 0;
    double best = 1e30;
    for (int i = 0; i < kTurns; ++i) {
        Report report;
        context.report = &report;
        Image image;
        if (!bench.passed(state, p.show(context, image))) return 0;
        best = std::min(best, stage_cpu(report, {"march", "blend"}));
        bench.check(state, which.name, image_digest(image));
    }
    return best;
}

void run_growth(benchmark::State& state, Bench& bench, const GrowthCase& which) {
    Overrides overrides = which.overrides;
    overrides.push_back("output.layers=[\"radiance\", \"alpha\"]");
    const std::unique_ptr<ReadyScene> p = bench.fresh(state, kCumulus128, overrides);
    if (p == nullptr) return;
    const Context context = with(p->context, p->context.kernels, 1);
    const std::size_t collectors = p->state().prepared.collectors.size();
    for (auto _ : state) {
        double seconds = 0;
        if (which.kind == GrowthCase::kPrepare)
            seconds = prepare_seconds(state, bench, which, context, *p);
        else if (which.kind == GrowthCase::kFrame)
            seconds = frame_seconds(state, bench, which, context, *p);
        else
            seconds = trace_seconds(state, bench, which, context, *p);
        state.SetIterationTime(seconds);
        state.counters["x"] = which.x > 0 ? which.x : double(collectors);
        state.counters["y"] = seconds * 1e3;
        if (which.kind > GrowthCase::kTracePerScattering) continue;
        TraceTally total{};
        for (const TraceTally& t : p->state().ring.photons.tallies) add_tally(t, total);
        state.counters["s/scattering"] = seconds / double(total.scatterings);
        state.counters["s/photon"] = seconds / double(total.photons);
        if (which.kind == GrowthCase::kTracePerScattering)
            state.counters["y"] = seconds / double(total.scatterings) * 1e9;
    }
}

std::vector<GrowthCase> growth_cases() {
    const std::string few = "collectors.generations=50", one = "collectors.generations=1",
                      lit = "collectors.photons=200000", march = "collectors.display=march",
                      blend = "collectors.display=billboards";
    std::vector<GrowthCase> cases;
    const auto add = [&](GrowthCase::Kind kind, const std::string& axis, double size, double x,
                         const Overrides& overrides) {
        const std::string name = "growth/" + axis + "/" + std::to_string(std::int64_t(size));
        cases.push_back({kind, name, x, overrides});
    };
    const auto number = [](const char* key, double value) {
        return key + ("=" + std::to_string(std::int64_t(value)));
    };
    for (double n : {64, 128, 256, 512}) {
        const std::string edge = std::to_string(int(n));
        const std::string grid = "medium.0.resolution=[" + edge + "," + edge + "," + edge + "]";
        add(GrowthCase::kTracePerScattering, "trace/voxels", n, n * n * n, {few, grid});
        add(GrowthCase::kPrepare, "prepare/voxels", n, n * n * n, {few, grid});
        if (n < 512) add(GrowthCase::kFrame, "march/voxels", n, n * n * n, {one, lit, march, grid});
    }
    for (double n : {2e3, 8e3, 32e3, 128e3}) {
        const std::string samples = number("collectors.samples", n);
        add(GrowthCase::kTracePerScattering, "trace/collectors", n, 0, {few, samples});
        add(GrowthCase::kPrepare, "prepare/samples", n, n, {few, samples});
        add(GrowthCase::kFrame, "blend/billboards", n, 0, {one, lit, blend, samples});
    }
    for (double n : {1e4, 1e5, 1e6})
        add(GrowthCase::kTrace, "trace/photons", n, n, {one, number("collectors.photons", n)});
    for (double n : {1, 2, 4, 8}) {
        const std::string width = std::to_string(int(480 * n)),
                          height = std::to_string(int(270 * n)),
                          size = "camera.resolution=[" + width + "," + height + "]";
        const double pixels = 480 * 270 * n * n;
        add(GrowthCase::kFrame, "march/pixels", pixels, pixels, {one, lit, march, size});
        add(GrowthCase::kFrame, "blend/pixels", pixels, pixels, {one, lit, blend, size});
    }
    // The same cloud in haze that is so many times thinner.
    for (double contrast : {1e1, 1e3, 1e6, 1e9}) {
        char haze[64];
        std::snprintf(haze, sizeof haze, "medium.1.extinction_per_m=%.3g", 0.05 / contrast);
        add(GrowthCase::kTracePerScattering, "trace/contrast", contrast, contrast,
            {few, "medium.1.density=uniform:box",
             "medium.1.bounds_m=[[-640,-640,0],[640,640,1280]]", haze});
    }
    return cases;
}

}  // namespace

void register_growth_cases(Bench& bench) {
    for (const GrowthCase& which : growth_cases())
        benchmark::RegisterBenchmark(
            which.name.c_str(),
            [&bench, which](benchmark::State& s) { run_growth(s, bench, which); })
            ->UseManualTime()
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
}

}  // namespace bench
