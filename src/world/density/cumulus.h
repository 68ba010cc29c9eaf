// SPDX-License-Identifier: Apache-2.0
// A procedural cumulus: turrets of bubbles with cauliflower tops over a flat base.
// in: a seed, a resolution, the box in metres -> out: relative densities, the same bits everywhere.
// docs/scene.md, "procedural:cumulus".
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels_cpu/isa/kernels.h"
#include "kernels_cpu/procedural/cumulus_params.h"
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/io/volumes/volume.h"

namespace pileus {

struct CumulusSettings {
    std::array<int, 3> resolution{160, 160, 110};  ///< cells along x, y, z; each 3 and more
    std::int64_t seed = 0;                         ///< another cloud for each
    Double3 extent_m{1600, 1600, 1100};            ///< the box; only its proportions matter
};

/// Fills `volume` with densities in [0, 1]: zero in the outermost layer of cells, about 0.3
/// just above the flat base, near 1 in the tops. `threads` 0 means all; the result doesn't depend
/// on it. A resolution of {0, 0, 0} stands for 160 x 160 x 110. The cloud keeps its own proportions
/// and fills the box as far as they allow; a box longer in x or y spreads it that way. Errors:
/// kBadInput for a box whose width over its height lies
/// outside 0.001..1000; kLimit when memory runs out.
Status make_cumulus(const CumulusSettings& settings, const KernelTable& kernels, int threads,
                    Volume& volume);

// The skeleton of a cumulus: spheres upon spheres upon spheres, from turrets down to buds, over the
// base plane z = 0. Cotton, Bryan, van den Heever 2011, "Storm and cloud dynamics", ch. 7.

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
