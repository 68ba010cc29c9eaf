// SPDX-License-Identifier: Apache-2.0
// What photons leave behind where light is measured rather than shown.
// in: nothing -> out: a mode of deposits beside DepositMode, and how collectors are numbered then.
// docs/flux.md, "By photons"
#pragma once
#include <cstdint>

namespace pileus {

/// TraceParams::mode: one number per collector and channel. A tentative collision deposits the
/// share of its light that the media there absorb, over the largest 1 - albedo of all media in that
/// channel. Light that leaves through top or bottom is deposited into collectors of its own.
constexpr std::int32_t kDepositAbsorbed = 16;

/// Behind its entry for every voxel, TraceBuffers::collector has one for every voxel's face on the
/// top and on the bottom of the grid: [MeterFace][y][x], none below 0.
enum MeterFace : std::int32_t {
    kTopTurned = 0,    ///< up through the top, turned at least once
    kTopStraight = 1,  ///< not turned by anything
    kBottomTurned = 2,
    kBottomStraight = 3,
};
constexpr int kMeterFaces = 4;

}  // namespace pileus
