// SPDX-License-Identifier: Apache-2.0
// Draws points where the density changes.
// in: a weight per voxel -> out: points distributed as that weight, with the density there.
// Elek 2011, section 5.2 (rejection); docs/methods.md 3, prepare 2 (stratified).
#pragma once
#include "src/base/buffer.h"
#include "src/methods/collectors/prepare/gradient.h"
#include "src/methods/collectors/prepare/prepared.h"

namespace pileus {

struct SampleOptions {
    std::uint32_t count = 20000;  ///< samples asked for
    std::uint64_t seed = 0;       ///< with stream and high: the key of the random numbers
    std::uint32_t stream = 0;
    std::uint32_t high = 0;
    std::uint32_t max_tries = 4096;  ///< rejection: per sample, then the sample is given up
};

struct SampleSet {
    Buffer<Sample> samples;      ///< ordered by their number; empty where the field is zero
    std::uint64_t tries = 0;     ///< points drawn altogether
    std::uint64_t given_up = 0;  ///< samples that no try hit (rejection only)
};

namespace arrays {

/// Sums of all rows before each row of the field, and the whole sum.
inline Array<double> row_sums(const Grid& grid) {
    return {"cumulative sums", std::uint64_t(grid.size[1]) * std::uint64_t(grid.size[2]) + 1,
            Stage::kSamples, Stage::kSamples};
}
inline Array<Sample> samples(std::uint64_t count) {
    return {"samples", count, Stage::kSamples, Stage::kLeafGrid};
}
/// Rejection: the samples before the gaps are closed, and the tries of each.
inline Array<Sample> drawn_samples(std::uint64_t count) {
    return {"samples being drawn", count, Stage::kSamples, Stage::kSamples};
}
inline Array<std::uint32_t> sample_tries(std::uint64_t count) {
    return {"samples being drawn", count, Stage::kSamples, Stage::kSamples};
}

}  // namespace arrays

/// One sample per equal share of the field's integral, by the exact inverse of its cumulative
/// sum in storage order; uniform within a voxel. Time is bounded. kLimit: out of memory.
Status sample_stratified(Span<const float> field, const FieldStats& stats,
                         Span<const float> density, const Grid& grid, const SampleOptions& options,
                         int threads, SampleSet& out);

/// The same distribution by rejection against the field's maximum. kLimit: out of memory.
Status sample_rejection(Span<const float> field, const FieldStats& stats, Span<const float> density,
                        const Grid& grid, const SampleOptions& options, int threads,
                        SampleSet& out);

}  // namespace pileus
