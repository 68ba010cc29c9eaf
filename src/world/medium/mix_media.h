// SPDX-License-Identifier: Apache-2.0
// Lays all media of a scene on one grid, so that every kernel keeps one look-up.
// in: the scene's media, each with its own box and voxels -> out: one Medium: the sum and its
// parts. docs/methods.md 2, "Several media".
#pragma once
#include <vector>

#include "src/plan/plan.h"
#include "src/scene/media/transfer.h"
#include "src/world/medium/medium.h"

namespace pileus {

constexpr std::uint64_t kMaxMixedVoxels = std::uint64_t{1} << 27;

/// A medium's box and how finely it is divided.
struct MixBox {
    Double3 low_m, extent_m;
    std::array<int, 3> size;
};

/// The common grid: the union of the boxes.
struct MixGrid {
    MixBox box;
    bool coarsened = false;  ///< the limit on voxels did not allow the finest voxel edges
};

/// Along each axis the finest voxel edge of all media, stretched to divide the union evenly; all
/// edges grow by one factor where there would be more than `most` voxels, and none becomes more
/// than 4096 to a side. Needs at least one box.
MixGrid plan_mix(const std::vector<MixBox>& boxes, std::uint64_t most = kMaxMixedVoxels);

/// Adds up the media, which are emptied. The sum's sigma is the largest of theirs; the mass times
/// sigma of each medium is kept. One medium is handed on as it is. kLimit: out of memory.
Status mix_media(std::vector<Medium>& media, const MixGrid& grid, int threads, Medium& out);

/// Which media would not keep their voxels on the grid, one flag each.
std::vector<bool> resampled_media(const std::vector<MixBox>& boxes, const MixGrid& grid);

/// What load_media will give, reading no values; `source` says what it will take meanwhile. Errors:
/// those of outline_medium.
Status outline_media(const Scene& scene, const Limits& limits, std::uint64_t threads, Plan& plan,
                     Medium& out, MediumSource& source, const HostMedia& given = {});

/// Loads every medium of a scene that has some and lays them on one grid; says in `plan` how.
/// Media without extinction are left out, unless none has any. Errors: those of load_medium.
Status load_media(const Scene& scene, const Limits& limits, int threads, Plan& plan, Medium& out,
                  const KernelTable* kernels = nullptr, const HostMedia& given = {});

// A field that a transfer function shows, as media: one for each colour. docs/scene.md, "A transfer
// function": a colour's extinction at a value is the sum over its rows of their extinction times
// their hat function, so that all colours add up to the linear law.

/// Splits `field`, which is emptied: its values, or none where it is an outline, whose densities
/// then count as 1. NaN is nothing. A colour that no value shows has density_max 0. kLimit: memory.
Status split_by_transfer(const std::vector<TransferRow>& rows, Medium& field,
                         std::vector<Medium>& out);

/// What the plan says of it.
std::string told_transfer(std::size_t medium, const std::vector<TransferRow>& rows);

}  // namespace pileus
