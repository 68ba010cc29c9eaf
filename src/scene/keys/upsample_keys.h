// SPDX-License-Identifier: Apache-2.0
// Keys of upsampling, temporal reprojection and light in slices: the same in each method with them.
// in: the method's field of UpsampleSettings -> out: fields and texts of rows.
// docs/upsampling.md
#pragma once
#include "src/scene/keys/all_keys.h"

namespace pileus::upsample_keys {

constexpr Allowed kScales = from_to(1, 4), kCells = from_to(0, 4);
constexpr const char* kScale =
    "1, 2 or 4: one pixel of so many along x and y is marched, the others are filled in";
constexpr const char* kUpsample =
    "how pixels between marched ones are filled in; `depth` minds what stands behind";
constexpr const char* kTemporal =
    "2 or 4: each frame marches one pixel of so many along x and y, in turn; the others "
    "come from the frame before; 0: frames know nothing of one another";

constexpr const char* kLightRefresh =
    "a sun that moves less than a degree in so many frames has its light on nodes and its "
    "shadow on the ground rebuilt by one part of so many each frame; 1: whole for each sun";

}  // namespace pileus::upsample_keys
