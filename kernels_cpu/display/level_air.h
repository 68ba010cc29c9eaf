// SPDX-License-Identifier: Apache-2.0
// Clear air as level layers, between two heights: closed forms, no steps.
// in: heights, km -> out: mean densities of air, haze and ozone on the way between them.
// docs/atmosphere.md, "Columns"
#pragma once
#include "kernels_cpu/core/math.h"

namespace pileus {

/// Heights over which air and haze thin out by e; ozone is a tent about its height.
constexpr float kAirScaleKm = 8.4f, kHazeScaleKm = 1.2f;
constexpr float kOzoneHeightKm = 25, kOzoneHalfKm = 15;

inline namespace PILEUS_ISA {

template <class T>
struct LevelAir {
    T air, haze, ozone;  ///< over their densities at the ground, ozone's over its largest
};

/// Mean of e^-(h / scale) from `low` on over `rise`, both >= 0.
template <class T>
PILEUS_FN T mean_thinning(T low, T rise, float scale) {
    const T x = rise * (1.0f / scale);
    const T mean = select(x > 1e-6f, one_minus_exp(x) / max_(x, all<T>(1e-6f)), all<T>(1.0f));
    return exp_(T{} - low * (1.0f / scale)) * mean;
}

/// Ozone at a height, and its column from the ground up to there.
template <class T>
PILEUS_FN T ozone_at(T height) {
    const T away = abs_(height - kOzoneHeightKm) * (1.0f / kOzoneHalfKm);
    return max_(1.0f - away, T{});
}
template <class T>
PILEUS_FN T ozone_below(T height) {
    const T most = all<T>(kOzoneHalfKm);
    const T up = max_(min_(height - (kOzoneHeightKm - kOzoneHalfKm), most), T{});
    const T down = max_(min_(height - kOzoneHeightKm, most), T{});
    return (up * up - down * down) * (0.5f / kOzoneHalfKm) + down;
}

/// Below the ground as on it.
template <class T>
PILEUS_FN LevelAir<T> level_air(T from, T to) {
    const T low = max_(min_(from, to), T{}), high = max_(max_(from, to), T{}), rise = high - low;
    LevelAir<T> mean;
    mean.air = mean_thinning(low, rise, kAirScaleKm);
    mean.haze = mean_thinning(low, rise, kHazeScaleKm);
    // Where the columns would cancel, the tent is straight but for its ends and its top.
    constexpr float kShort = 0.05f;
    const T column = (ozone_below(high) - ozone_below(low)) / max_(rise, all<T>(kShort));
    mean.ozone = select(rise > kShort, column, ozone_at(0.5f * (low + high)));
    return mean;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
