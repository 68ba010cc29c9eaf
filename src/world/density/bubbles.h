// SPDX-License-Identifier: Apache-2.0
// The skeleton of a cumulus: spheres upon spheres upon spheres, from turrets down to buds.
// in: a seed, the box's proportions -> out: a list of spheres over the base plane z = 0.
// Cumulus structure: Cotton, Bryan, van den Heever 2011, "Storm and cloud dynamics", ch. 7.
#pragma once
#include <cstddef>
#include <cstdint>

#include "kernels_cpu/procedural/cumulus_params.h"
#include "src/base/buffer.h"
#include "src/base/status.h"

namespace pileus {

struct BubbleList {
    Buffer<Bubble> bubbles;  ///< kMaxBubbles reserved
    std::size_t count = 0;
    float top = 0;  ///< highest point over the base

    /// Drops what no longer fits the reserve.
    void add(const Bubble& bubble) {
        if (count < bubbles.size()) bubbles[count++] = bubble;
    }
};

/// Grows a cloud as large as fits between x = +-half_x, y = +-half_y and below z = height; spheres
/// may reach below the base plane, where the caller cuts them. All lengths in one unit, > 0.
/// Errors: kLimit when memory runs out.
Status grow_bubbles(std::uint64_t seed, float half_x, float half_y, float height, BubbleList& list);

}  // namespace pileus
