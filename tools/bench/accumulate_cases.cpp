// SPDX-License-Identifier: Apache-2.0
// What one deposit of 16 coefficients costs: into sums of a thread alone, and of all threads.
// in: events at random collectors -> out: ns of CPU per event; equal sums both ways.
// docs/collectors.md, "Accumulation"; docs: README.md in this folder.
#include "kernels_cpu/core/accumulate.h"
#include "kernels_cpu/core/rng.h"
#include "platform/threads.h"
#include "src/base/digest.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

constexpr int kCoefficients = 16;
constexpr std::uint32_t kCollectors = 8192;  // 1 MiB of sums, as of a small cloud
constexpr std::uint32_t kEvents = 1u << 18;  // of one iteration
constexpr std::uint32_t kPieceEvents = 1u << 12;

/// Event numbers [first, first + kPieceEvents): a collector and 16 small numbers each.
void deposit_piece(std::uint32_t first, std::int64_t* sums, bool shared) {
    for (std::uint32_t e = first; e < first + kPieceEvents; ++e) {
        const Words<std::uint32_t> w = threefry(1u, 2u, e, 3u);
        std::int32_t numbers[kCoefficients];
        for (int c = 0; c < kCoefficients; ++c) numbers[c] = std::int32_t(w.b >> c) & 0xffff;
        add_sums(sums + std::size_t(w.a % kCollectors) * kCoefficients, numbers, 0, kCoefficients,
                 shared);
    }
}

void run_accumulate(benchmark::State& state, Bench& bench, int threads, bool shared) {
    constexpr std::size_t kNumbers = std::size_t(kCollectors) * kCoefficients;
    Buffer<std::int64_t> sums;
    if (!bench.passed(state, sums.resize(kNumbers * std::size_t(shared ? 1 : threads), "sums")))
        return;
    for (auto _ : state) {
        for (std::int64_t& v : sums.span()) v = 0;
        parallel_for(threads, kEvents / kPieceEvents, [&](std::int64_t piece, int thread) {
            deposit_piece(std::uint32_t(piece) * kPieceEvents,
                          sums.data() + (shared ? 0 : kNumbers * std::size_t(thread)), shared);
        });
        for (int t = 1; t < threads && !shared; ++t)
            for (std::size_t i = 0; i < kNumbers; ++i)
                sums[i] += sums[kNumbers * std::size_t(t) + i];
        state.PauseTiming();
        Digest digest;
        digest.integers({sums.data(), kNumbers});
        bench.check(state, "accumulate", digest.value());
        state.ResumeTiming();
    }
    state.counters["s/event"] =
        benchmark::Counter(double(state.iterations()) * kEvents,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

void register_accumulate_cases(Bench& bench) {
    for (const int threads : {1, hardware_threads()})
        for (const bool shared : {false, true})
            benchmark::RegisterBenchmark(
                (std::string("accumulate/") + (shared ? "shared" : "private") +
                 (threads > 1 ? "/threads:" + std::to_string(threads) : ""))
                    .c_str(),
                [&bench, threads, shared](benchmark::State& s) {
                    run_accumulate(s, bench, threads, shared);
                })
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
}

}  // namespace bench
