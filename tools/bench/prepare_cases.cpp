// SPDX-License-Identifier: Apache-2.0
// Preparation: everything between the density and the photons, by cloud and number of samples.
// in: a cloud read once -> out: CPU ms of all stages together and of each, digest checked.
// docs: README.md in this folder. The time column is CPU time of the stages, not of the digest.
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

struct PrepareCase {
    std::string name, scene;
    int samples;
    int threads;
};

const Stages kStages = {"gradient", "samples", "tree", "collectors", "majorants"};

void run_prepare(benchmark::State& state, Bench& bench, const PrepareCase& which) {
    ReadyScene* p = bench.prepared(state, which.scene, {});
    if (p == nullptr) return;
    CollectorSettings settings = p->scene.collectors;
    settings.placement.samples = which.samples;
    Report report;
    Context context = with(p->context, p->context.kernels, which.threads);
    context.report = &report;
    for (auto _ : state) {
        report.clocks.stages.clear();
        pileus::Prepared out;
        pileus::Majorants majorants;
        if (!bench.passed(state, prepare_collectors(p->scenery.world->medium, settings,
                                                    p->scene.seed, context, out)) ||
            !bench.passed(state,
                          make_majorants(p->scenery.world->medium, true, context, majorants)))
            return;
        state.SetIterationTime(stage_cpu(report, kStages));
        bench.check(state, which.name, prepared_digest(out, majorants));
        state.counters["collectors"] = double(out.collectors.size());
    }
    count_stages(state, report);
}

}  // namespace

void register_prepare_cases(Bench& bench) {
    const int all = hardware_threads();
    for (const char* scene : {"cumulus", kCumulus128})
        for (const auto& [label, samples] : {std::pair{"20k", 20'000}, std::pair{"100k", 100'000}})
            for (int threads : {1, all}) {
                const std::string of = scene == kCumulus128 ? "/cumulus128" : "";
                const PrepareCase which{"prepare" + of + "/" + label, scene, samples, threads};
                const std::string suffix =
                    threads == 1 ? "" : "/threads:" + std::to_string(threads);
                benchmark::RegisterBenchmark(
                    (which.name + suffix).c_str(),
                    [&bench, which](benchmark::State& s) { run_prepare(s, bench, which); })
                    ->UseManualTime()
                    ->Unit(benchmark::kMillisecond);
                if (all == 1) break;
            }
}

}  // namespace bench
