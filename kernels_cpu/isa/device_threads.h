// SPDX-License-Identifier: Apache-2.0
// What one thread of a device does: one item of a launch, its tallies added to those of all.
// in: a kernel, its arguments and the item's number -> out: as the kernel; sums added atomically.
// docs/crosscheck.md: the device and the test that stands in for it run these same bodies.
#pragma once
#include "kernels_cpu/core/accumulate.h"
#include "kernels_cpu/isa/kernels.h"

namespace pileus {

/// Of self_test: the digest's place. It has no parameters.
struct NoParams {};
struct SelfTestBuffers {
    std::uint64_t* digest;
};

inline namespace PILEUS_ISA {

/// Adds a thread's own struct of 64-bit counters to the one that all threads share.
template <class Tally>
PILEUS_FN void add_tally_shared(const Tally& own, Tally* all) {
    static_assert(sizeof(Tally) % sizeof(std::int64_t) == 0, "counters of 64 bits alone");
    const auto* from = reinterpret_cast<const std::int64_t*>(&own);
    auto* to = reinterpret_cast<std::int64_t*>(all);
    for (unsigned i = 0; i < sizeof(Tally) / sizeof(std::int64_t); ++i)
        if (from[i] != 0) add_sum(to + i, from[i], true);
}

/// Rows and nodes need nothing of their own.
template <class Kernel, class Params, class Buffers>
PILEUS_FN void run_item(Kernel kernel, const Params& k, const Buffers& b, std::uint32_t,
                        std::uint32_t item) {
    kernel(k, b, item, item + 1);
}

/// A photon adds to sums that all threads share.
template <class Kernel>
PILEUS_FN void run_item(Kernel kernel, const TraceParams& k, const TraceBuffers& b, std::uint32_t,
                        std::uint32_t item) {
    TraceTally tally{};
    TraceBuffers own = b;
    own.tally = &tally;
    own.shared_sums = 1;
    kernel(k, own, item, item + 1);
    add_tally_shared(tally, b.tally);
}

/// A sample stores its radiance in a place of its own.
template <class Kernel>
PILEUS_FN void run_item(Kernel kernel, const PathParams& k, const PathBuffers& b, std::uint32_t,
                        std::uint32_t item) {
    PathTally tally{};
    PathBuffers own = b;
    own.tally = &tally;
    kernel(k, own, item, item + 1);
    add_tally_shared(tally, b.tally);
}

/// A tile has planes of its own, the launch's first tile the first ones.
template <class Kernel>
PILEUS_FN void run_item(Kernel kernel, const BlendParams& k, const BlendBuffers& b,
                        std::uint32_t begin, std::uint32_t item) {
    BlendBuffers own = b;
    own.scratch = b.scratch + std::uint64_t(item - begin) * blend_scratch_share(k);
    kernel(k, own, item, item + 1);
}

/// Rows of a cumulus: each has lists of its own, the launch's first row the first ones.
template <class Kernel>
PILEUS_FN void run_item(Kernel kernel, const CumulusParams& k, const CumulusBuffers& b,
                        std::uint32_t begin, std::uint32_t item) {
    CumulusBuffers own = b;
    own.scratch = b.scratch + std::uint64_t(item - begin) * std::uint64_t(kCumulusScratch);
    kernel(k, own, item, item + 1);
}

/// Tiles of particles: each has bins of its own, the launch's first tile the first ones.
template <class Kernel>
PILEUS_FN void run_item(Kernel kernel, const ParticleMarchParams& k, const ParticleTileBuffers& b,
                        std::uint32_t begin, std::uint32_t item) {
    ParticleTileBuffers own = b;
    own.march.scratch =
        b.march.scratch + std::uint64_t(item - begin) * particle_scratch_share(k.bins);
    kernel(k, own, item, item + 1);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
