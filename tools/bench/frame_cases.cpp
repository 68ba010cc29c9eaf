// SPDX-License-Identifier: Apache-2.0
// Preparation and display: CPU time of the stages that make one frame, of the default cloud.
// in: prepared and lit scenes -> out: ms per frame and stage, digests checked.
// docs: README.md in this folder. The time column is the CPU time of the named stages only.
#include <cstring>
#include <utility>

#include "src/base/digest.h"
#include "src/io/image_file.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;
using Stages = std::vector<const char*>;

double seconds(const Report& report, const Stages& stages) {
    double sum = 0;
    for (const char* stage : stages) sum += stage_cpu(report, stage);
    return sum;
}

/// Every number the preparation made.
std::uint64_t prepared_digest(const pileus::Prepared& p) {
    Digest digest;
    for (const Collector& c : p.collectors.span()) {
        digest.floats({c.centre, 3});
        for (float v : {c.radius, c.billboard_radius, c.extinction}) digest.f32(v);
    }
    for (std::int32_t v : p.collector_of_voxel.span()) digest.u32(std::uint32_t(v));
    digest.floats(p.majorants.span());
    digest.floats(p.skip_majorants.span());
    return digest.value();
}

void run_prepare(benchmark::State& state, Bench& bench, const std::string& name, int samples) {
    ReadyScene* p = bench.prepared(state, "cumulus", {});
    if (p == nullptr) return;
    CollectorSettings settings = p->scene.collectors;
    settings.samples = samples;
    Report report;
    Context context = with(p->context, p->context.kernels, 1);
    context.report = &report;
    for (auto _ : state) {
        report.stages.clear();
        pileus::Prepared out;
        if (!bench.passed(
                state, prepare_collectors(p->run.medium, settings, p->scene.seed, context, out)) ||
            !bench.passed(state, prepare_majorants(p->run.medium, true, context, out)))
            return;
        state.SetIterationTime(seconds(report, {"samples", "tree", "majorants"}));
        bench.check(state, name, prepared_digest(out));
        state.counters["collectors"] = double(out.collectors.size());
    }
}

/// What one case of the display is.
struct FrameCase {
    std::string name;
    Overrides overrides;
    Stages stages;  ///< whose CPU time counts
    bool shadow;    ///< make the sun's optical depths anew
    bool lanes;     ///< made by a kernel: one case per instruction set
};

/// A lit run: one generation of photons is enough to see the time.
ReadyScene* lit(benchmark::State& state, Bench& bench, const FrameCase& which) {
    Overrides overrides = which.overrides;
    for (const char* o : {"collectors.photons=200000", "collectors.generations=1",
                          "output.layers=[\"radiance\", \"alpha\"]"})
        overrides.push_back(o);
    ReadyScene* p = bench.prepared(state, "cumulus", overrides);
    if (p == nullptr || p->run.photons.slots[0].generations > 0) return p;
    return bench.passed(state, collectors_shoot(p->context, p->run)) ? p : nullptr;
}

void run_frame(benchmark::State& state, Bench& bench, const FrameCase& which,
               const KernelTable* kernels, int threads) {
    ReadyScene* p = lit(state, bench, which);
    if (p == nullptr) return;
    Report report;
    Context context = with(p->context, kernels, threads);
    context.report = &report;
    for (auto _ : state) {
        report = Report{};
        if (which.shadow) p->run.shadow_ready = false;
        Image image;
        if (!bench.passed(state, collectors_show(0, context, p->run, image))) return;
        state.SetIterationTime(seconds(report, which.stages));
        Digest digest;
        for (char c : pixel_hash(image)) digest.byte(std::uint8_t(c));
        digest.floats(p->run.shadow.span());
        bench.check(state, which.name, digest.value());
    }
    // The last frame's other stages, for the whole picture.
    for (const StageTime& s : report.stages) state.counters[s.name + "_ms"] = s.cpu_s * 1e3;
}

}  // namespace

void register_frame_cases(Bench& bench) {
    for (const auto& [label, samples] : {std::pair{"20k", 20'000}, std::pair{"100k", 100'000}}) {
        const std::string name = std::string("prepare/") + label;
        const int count = samples;
        benchmark::RegisterBenchmark(
            name.c_str(),
            [&bench, name, count](benchmark::State& s) { run_prepare(s, bench, name, count); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
    }
    const std::string full = "camera.resolution=[1920, 1080]", few = "camera.resolution=[64, 36]";
    const std::string march = "collectors.display=march", blend = "collectors.display=billboards";
    const FrameCase cases[] = {
        {"shadow", {few, march}, {"shadow"}, true, true},
        {"reconstruct", {few, march}, {"reconstruct"}, false, false},
        {"march/1920x1080", {full, march}, {"march"}, false, true},
        {"blend/1920x1080", {full, blend}, {"blend"}, false, true},
    };
    for (const FrameCase& which : cases)
        for_each_machine([&](const std::string& suffix, const KernelTable* kernels, int threads) {
            if (!which.lanes && kernels != kernel_table(nullptr)) return;
            benchmark::RegisterBenchmark((which.name + suffix).c_str(),
                                         [&bench, which, kernels, threads](benchmark::State& s) {
                                             run_frame(s, bench, which, kernels, threads);
                                         })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
        });
}

}  // namespace bench
