// SPDX-License-Identifier: Apache-2.0
// The program's elementary functions and random numbers, beside the C library's.
// in: 16 384 numbers in (0, 1] -> out: seconds a value, and how many times as fast as libm.
// docs: README.md in this folder. A value of Threefry is one word of 32 bits, of sincos a pair.
#include <algorithm>
#include <cmath>

#include "platform/clock.h"
#include "tools/bench/bench.h"
#include "tools/bench/lane_floor.h"

namespace bench {
namespace {

using namespace pileus;

constexpr std::uint32_t kCount = 1u << 14;

struct MathCase {
    const char* name;
    MathKind kind;
    float (*libm)(float);  ///< null: it has none
    int words;             ///< values a call
};

/// Fastest of ten, seconds.
template <class Work>
double fastest(Work work) {
    double best = 1e30;
    for (int i = 0; i < 10; ++i) {
        const double start = cpu_seconds();
        work();
        best = std::min(best, cpu_seconds() - start);
    }
    return best;
}

void run_math(benchmark::State& state, Bench& bench, const MathCase& which, const char* isa) {
    const LaneFloors* lanes = lane_floors(isa);
    std::vector<float> x(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) x[i] = float(i * 2654435761u >> 8 | 1u) * 0x1p-24f;
    for (auto _ : state) bench.check(state, which.name, lanes->math(which.kind, x.data(), kCount));
    const auto ours = [&] { benchmark::DoNotOptimize(lanes->math(which.kind, x.data(), kCount)); };
    const double own = fastest(ours) / (double(kCount) * which.words);
    state.counters["s/value"] = own;
    if (which.libm == nullptr) return;
    const auto theirs = [&] {
        float sum = 0;
        for (float v : x) sum += which.libm(v);
        benchmark::DoNotOptimize(sum);
    };
    state.counters["times_libm"] = fastest(theirs) / double(kCount) / own;
}

}  // namespace

void register_math_cases(Bench& bench) {
    const MathCase cases[] = {
        {"math/log", MathKind::kLog, [](float v) { return std::log(v); }, 1},
        {"math/exp", MathKind::kExp, [](float v) { return std::exp(-v); }, 1},
        {"math/sincos", MathKind::kSinCos,
         [](float v) {
             const float a = 6.2831853f * v;
             return std::sin(a) + std::cos(a);
         },
         1},
        {"math/atan2", MathKind::kAtan2, [](float v) { return std::atan2(v, 1.0f - v); }, 1},
        {"math/threefry", MathKind::kThreefry, nullptr, 2},
    };
    for (const MathCase& which : cases)
        for_each_machine([&](const std::string& suffix, const KernelTable* kernels, int threads) {
            if (threads > 1) return;
            const char* isa = kernels->name;
            benchmark::RegisterBenchmark(
                (which.name + suffix).c_str(),
                [&bench, which, isa](benchmark::State& s) { run_math(s, bench, which, isa); })
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
        });
}

}  // namespace bench
