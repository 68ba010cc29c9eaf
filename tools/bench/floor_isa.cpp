// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set, with the definitions and flags of kernels_cpu/isa/isa.cpp.
// in: FloorWork -> out: a checksum that depends on every word drawn and every number loaded.
// Per tentative collision two Threefry calls, a logarithm, a density and a collector; per
// scattering one more call; per collision or crossing one majorant. All lanes full.
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "tools/bench/floor.h"

namespace bench {
namespace {

using namespace pileus;

constexpr int W = PILEUS_WIDTH;
constexpr std::uint32_t k0 = 0x13579bdfu, k1 = 0x2468ace0u;

/// A number below `n`, evenly spread, for n <= 2^24; rounding must not reach n itself.
I<W> below(std::uint32_t n, U<W> word) {
    return min_(to_int(uniform(word) * float(n)), all<I<W>>(std::int32_t(n) - 1));
}

U<W> items(std::uint32_t first) { return reinterpret<U<W>>(iota<I<W>>()) + first; }

/// Sums the lanes of the items below `count`.
std::uint32_t sum(U<W> words, U<W> number, std::uint32_t count) {
    const U<W> kept = select(number < count, words, U<W>{});
    std::uint32_t total = 0;
    for (int l = 0; l < W; ++l) total += lane(kept, l);
    return total;
}

std::uint32_t run_floor(const FloorWork& work) {
    std::uint32_t total = 0;
    for (std::uint32_t i = 0; i < work.tentative; i += W) {
        const U<W> number = items(i);
        const Words<U<W>> a = threefry(k0, k1, number, U<W>{}),
                          b = threefry(k0, k1, number, U<W>{} + 1u);
        const F<W> tau = F<W>{} - log_(uniform_open(a.a));
        const I<W> voxel = below(work.voxels, b.a);
        const F<W> density = gather(work.density, voxel);
        const F<W> bound = gather(work.majorant, below(work.blocks, a.b));
        const I<W> collector = gather(work.collector, voxel);
        total += sum(reinterpret<U<W>>(tau) + reinterpret<U<W>>(density) +
                         reinterpret<U<W>>(bound) + reinterpret<U<W>>(collector) + b.b,
                     number, work.tentative);
    }
    // Crossings draw nothing: a cheap hash stands for where they lead.
    for (std::uint32_t i = 0; i < work.crossings; i += W) {
        const U<W> number = items(i);
        const F<W> bound = gather(work.majorant, below(work.blocks, number * 0x9E3779B9u));
        total += sum(reinterpret<U<W>>(bound), number, work.crossings);
    }
    for (std::uint32_t i = 0; i < work.scatterings; i += W) {
        const U<W> number = items(i);
        const Words<U<W>> w = threefry(k0, k1, number, U<W>{} + 2u);
        total += sum(w.a + w.b, number, work.scatterings);
    }
    return total;
}

}  // namespace

#define BENCH_JOIN(a, b) a##b
#define BENCH_FLOOR(isa) BENCH_JOIN(floor_, isa)
extern const FloorKernel BENCH_FLOOR(PILEUS_ISA);
const FloorKernel BENCH_FLOOR(PILEUS_ISA) = run_floor;

}  // namespace bench
