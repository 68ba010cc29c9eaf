// SPDX-License-Identifier: Apache-2.0
// The preparation as one step: samples, tree, leaves, collectors.
// in: a medium and the collectors' settings -> out: everything that photons need, read only.
// docs/methods.md 3 "Prepare"; each part is described in its own prepare_*.h.
#pragma once
#include "src/methods/collectors/prepare/prepared.h"
#include "src/methods/collectors/prepare/samples.h"
#include "src/run/context.h"
#include "src/world/medium/medium.h"

namespace pileus {

struct Prepared {
    Buffer<Leaf> leaves;
    Buffer<Collector> collectors;
    Buffer<std::int32_t> collector_of_voxel;  ///< -1 where a leaf holds no medium
    Buffer<float> shares;  ///< [collector][medium] of the extinction; none for one medium
    std::uint64_t samples = 0, rejected = 0;
    double cell_m = 0;  ///< shortest edge that leaves are halved down to; 0: they are not
};

/// The field that samples are drawn from, one number per voxel: the gradient's magnitude, or the
/// local variance where the settings ask for it. kLimit: out of memory.
Status prepare_sample_field(const Medium& medium, const CollectorSettings& settings,
                            const Context& context, Buffer<float>& field, FieldStats& stats);

/// The samples that `prepare_collectors` builds its tree from. kLimit: out of memory.
Status prepare_sample_set(const Medium& medium, const CollectorSettings& settings,
                          std::int64_t seed, const Context& context, SampleSet& set);

/// Longest leaf as a share of the common box's diagonal: a small cloud in wide haze is divided as
/// finely as it would be alone.
double leaf_share(const Medium& medium);

/// kLimit: out of memory.
Status prepare_collectors(const Medium& medium, const CollectorSettings& settings,
                          std::int64_t seed, const Context& context, Prepared& out);

/// Regular cells of `edge` voxels instead of leaves: one collector per cell that holds medium.
/// Used by the camera-directed estimate that `variant` is measured against.
Status prepare_cells(const Medium& medium, int edge, const Context& context, Prepared& out);

}  // namespace pileus
