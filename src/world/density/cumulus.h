// SPDX-License-Identifier: Apache-2.0
// A procedural cumulus: turrets of bubbles with cauliflower tops over a flat base.
// in: a seed, a resolution, the box in metres -> out: relative densities, the same bits everywhere.
// docs/scene.md, "procedural:cumulus".
#pragma once
#include <array>
#include <cstdint>

#include "kernels_cpu/isa/kernels.h"
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

}  // namespace pileus
