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
    const float* shadow = nullptr;  ///< side^2; null: none
    int side = kSunTexels;
    /// Of a layer, which shades all that is lower than its middle, and whose `shadow` is
    /// total_left: the sun that it was drawn for, and what it leaves beyond its square. Null: a
    /// cloud.
    const SunPlane* plane = nullptr;
    float beyond = 1;
};

/// Share of light that comes through a depth at all, scattered too, where `left` of it comes
/// straight: two streams without absorption, 1 / (1 + 3/4 (1 - g) depth) (Bohren 1987).
float total_left(float left, double mean_cosine);

/// Share of sunlight that a source leaves at a place, wherever that is along the sun's way.
float left_by(const ShadowSource& source, const SunPlane& plane, const Double3& at);

/// Whether a source stands between a place and the sun.
bool is_sunward(const ShadowSource& source, const SunPlane& plane, const Double3& at);

/// Share of sunlight that comes to a place of the world through all that stands towards the sun.
/// Number `own`, if there is one, does not count. `spread`: what clouds scatter forward counts,
/// too, as on something that is lit from all around.
float sunlight_left(const SunPlane& plane, const std::vector<ShadowSource>& all, const Double3& at,
                    bool spread = false);

/// Share of sunlight between texels, at (x, y) from -1 to 1, right and up; 1 beyond.
float shadow_at(const float* texels, int side, float x, float y);

/// Texels along a side of the shadow that lies on a cloud.
constexpr int kShadeTexels = 32;

/// The shadow of others on a cloud; empty: none. kLimit: out of memory.
Status shade_cloud(const SunPlane& plane, const std::vector<ShadowSource>& all, std::size_t own,
                   Buffer<float>& shade);

/// The shadow of all on the ground, as depths that background kernels read between nodes; of layers
/// within their squares.
struct CloudsOnGround {
    NodeGrid nodes{};    ///< size 0: none
    double low[2] = {};  ///< m of the world
    Buffer<float> depth;
};
Status shade_ground(const SunPlane& plane, const std::vector<ShadowSource>& all, double ground_m,
                    CloudsOnGround& out);

}  // namespace pileus
