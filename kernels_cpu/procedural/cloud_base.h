// SPDX-License-Identifier: Apache-2.0
// The base of a storm: a lip along the side that the wind blows to, and shreds.
// in: lanes of places, distances to the heap's surface -> out: how far the base hangs down there.
// docs/generators.md, "Shelf"
#pragma once
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/procedural/cloud_params.h"
#include "kernels_cpu/procedural/noise.h"

namespace pileus {
inline namespace PILEUS_ISA {

// In drops of the lip, k.shelf.
constexpr float kShelfMost = 1.5f;   // with shreds
constexpr float kShelfReach = 5.0f;  // height from which on there is nothing of it

/// Metres that the base hangs down, less and less at places at some height over it. `core`:
/// distance to the surface of the balls.
template <class T>
PILEUS_FN T shelf_drop(const CloudParams& k, const Vec<T>& p, T level, T core) {
    // The lip lies within the rim; inside it the base is higher.
    const float wide = 0.035f * k.height;
    const T t = (core + wide) * (1.0f / wide);
    const T lip = max_(1.0f - t * t, T{});
    const T ahead = smooth_ramp<T>(0.35f + (p.x * k.shelf_x + p.y * k.shelf_y) * (1.1f / k.foot));
    const float coarse = 1.0f / (0.06f * k.height), fine = 1.0f / (0.022f * k.height);
    const T shreds = gradient_noise<T>(p.x * coarse, p.y * coarse, p.z * coarse, k.seed + 48u) +
                     0.6f * gradient_noise<T>(p.x * fine, p.y * fine, p.z * fine, k.seed + 49u);
    const T drop = lip * lip * ahead * (0.8f + 0.5f * shreds) + 0.9f * shreds;
    const T share = 1.0f - smooth_ramp<T>(level * (1.0f / (kShelfReach * k.shelf)));
    return k.shelf * share * max_(min_(drop, all<T>(kShelfMost)), all<T>(-0.6f));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
