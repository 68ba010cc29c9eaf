// SPDX-License-Identifier: Apache-2.0
// The sun's optical depth on every voxel of 512 x 256 x 256, by the axis its slices follow.
// in: a made-up sky of broken clouds -> out: CPU and wall ms of a sweep into memory that is there.
// docs: README.md in this folder.
#include <algorithm>

#include "src/base/digest.h"
#include "src/picture/nodes/sun_depth.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

struct SweepCase {
    std::string name;
    std::array<float, 3> to_sun;
    bool periodic;
};

/// Blobs in a third of the air; polynomials, so that every machine has the same.
Status make_sky(Medium& m) {
    const int size[3] = {512, 256, 256};
    for (int a = 0; a < 3; ++a) {
        m.volume.size[std::size_t(a)] = m.grid.size[a] = size[a];
        m.extent_m[a] = 20.0 * size[a];
        m.grid.cell_m[a] = 20;
    }
    PILEUS_TRY(m.volume.density.resize(voxel_count(m.grid), "density"));
    const auto wave = [](int i, int period) {
        const float t = float(i % period) / float(period);
        return 4 * t * (1 - t);
    };
    std::size_t voxel = 0;
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i) {
                const float v = wave(i, 97) * wave(j, 61) * wave(k, 128) - 0.4f;
                m.volume.density[voxel++] = v > 0 ? v : 0;
            }
    m.density_max = 0.6f;
    m.sigma = 0.02f;
    return Status::ok();
}

void run_sweep(benchmark::State& state, Bench& bench, const SweepCase& which,
               const KernelTable* table, int threads) {
    Medium medium;
    if (!bench.passed(state, make_sky(medium))) return;
    medium.grid.periodic = which.periodic;
    Report report;
    Context context;
    context.kernels = table;
    context.threads = threads;
    context.report = &report;
    const Majorants majorants;
    SunDepth depth;
    double best_wall = 1e9;
    const auto once = [&] {
        report.clocks.stages.clear();
        return bench.passed(state, make_sun_depth(context, medium, majorants, which.to_sun,
                                                  SunDepthKind::kSwept, depth));
    };
    if (!once()) return;  // takes the memory
    for (auto _ : state) {
        if (!once()) return;
        state.SetIterationTime(stage_cpu(report, {"shadow"}));
        best_wall = std::min(best_wall, stage_wall(report, {"shadow"}));
    }
    Digest digest;
    digest.floats(depth.optical_depth.span());
    bench.check(state, which.name, digest.value());
    state.counters["best_wall_ms"] = best_wall * 1e3;
}

}  // namespace

void register_sweep_cases(Bench& bench) {
    const SweepCase cases[] = {{"sweep/512x256x256/x", {0.9f, 0.3f, 0.2f}, false},
                               {"sweep/512x256x256/y", {0.3f, 0.9f, 0.2f}, false},
                               {"sweep/512x256x256/z", {0.3f, 0.2f, 0.9f}, false},
                               {"sweep/512x256x256/periodic", {0.5f, 0.3f, 0.8f}, true}};
    for (const SweepCase& which : cases)
        for_each_machine([&](const std::string& suffix, const KernelTable* table, int threads) {
            benchmark::RegisterBenchmark((which.name + suffix).c_str(),
                                         [&bench, which, table, threads](benchmark::State& s) {
                                             run_sweep(s, bench, which, table, threads);
                                         })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
        });
}

}  // namespace bench
