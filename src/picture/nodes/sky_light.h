// SPDX-License-Identifier: Apache-2.0
// Sunlight on nodes in levels around the camera, for a sky in place: what each sample would march.
// in: a sky, a camera, the sun -> out: optical depths on the nodes that the view may read.
// docs/skies.md, "Sunlight on nodes".
#pragma once
#include "kernels_cpu/raymarch/raymarch_params.h"
#include "src/picture/nodes/sun_slices.h"
#include "src/plan/array.h"
#include "src/world/density/sky_field.h"

namespace pileus {

struct SkyLight {
    SkyLightView view{};
    Buffer<std::int32_t> words;
    std::vector<std::int32_t> row;   ///< [level][height][row]: the row that is kept there
    std::vector<NodeRange> columns;  ///< and which of its columns are made
    SunSlices slices;
    std::uint64_t made = 0, densities = 0;  ///< nodes so far, and what was read for them
};

/// Levels that reach to the end of the rays, or of the box.
int sky_light_levels(const SkyParams& sky, int bits);

namespace arrays {

/// `last` marches.
inline Array<std::int32_t> sky_light_nodes(int levels, int bits, Stage last) {
    return {"sunlight on nodes of the sky",
            bytes_of(std::uint64_t(levels) * kSkyLightHeights, std::uint64_t{1} << (2 * bits)),
            Stage::kShadow, last};
}

}  // namespace arrays

/// Room for 2^bits nodes along x and y and any number of slices. kLimit: out of memory.
Status reserve_sky_light(const SkyParams& sky, int bits, SkyLight& out);

/// Makes the nodes that the camera of `k` may read and that `out` does not hold for their slice's
/// sun: 2^bits along x and y. `near_steps` of the march to the sun are left to samples. kLimit: out
/// of memory.
Status follow_sky_light(const Context& context, const RaymarchParams& k, const SkyParams& sky,
                        int bits, int near_steps, const SunTurn& turn, SkyLight& out);

}  // namespace pileus
