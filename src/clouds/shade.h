// SPDX-License-Identifier: Apache-2.0
// Shadows of clouds on one another and on the ground.
// in: where clouds are, each kind's shadow seen from the sun -> out: the share of sunlight left.
// docs/clouds.md, "Shadows"
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "src/clouds/group.h"

namespace pileus {

/// What throws a shadow: the square of `shadow` about `middle`, half a side `radius` m of the
/// world.
struct ShadowSource {
    Double3 middle{};
    double radius = 0;
    const float* shadow = nullptr;  ///< kSunTexels^2; null: none
};

/// Share of sunlight between texels, at (x, y) from -1 to 1, right and up; 1 beyond.
float shadow_at(const float* texels, int side, float x, float y);

/// Texels along a side of the shadow that lies on a cloud.
constexpr int kShadeTexels = 32;

/// The shadow of others on a cloud; empty: none. kLimit: out of memory.
Status shade_cloud(const SunPlane& plane, const std::vector<ShadowSource>& all, std::size_t own,
                   Buffer<float>& shade);

/// The shadow of all on the ground, as depths that background kernels read between nodes.
struct CloudsOnGround {
    NodeGrid nodes{};    ///< size 0: none
    double low[2] = {};  ///< m of the world
    Buffer<float> depth;
};
Status shade_ground(const SunPlane& plane, const std::vector<ShadowSource>& all, double ground_m,
                    CloudsOnGround& out);

}  // namespace pileus
