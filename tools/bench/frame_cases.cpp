// SPDX-License-Identifier: Apache-2.0
// Display: CPU time of the stages that make one frame, of the default cloud.
// in: lit scenes -> out: ms per frame and stage, digests checked.
// docs: README.md in this folder. The time column is the CPU time of the named stages only.
#include "src/base/digest.h"
#include "src/io/image_file.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

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
        state.SetIterationTime(stage_cpu(report, which.stages));
        Digest digest;
        for (char c : pixel_hash(image)) digest.byte(std::uint8_t(c));
        digest.floats(p->run.shadow.span());
        bench.check(state, which.name, digest.value());
    }
    // The last frame's other stages, for the whole picture.
    count_stages(state, report);
}

}  // namespace

void register_frame_cases(Bench& bench) {
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
