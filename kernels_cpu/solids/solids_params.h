// SPDX-License-Identifier: Apache-2.0
// Solid things as rays see them: triangles under a tree of boxes, in plain structs.
// in: src/world/solids/solids.h -> out: the layout that kernels read.
// docs/solids.md. Lengths in metres, box-local.
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/light/sun_heights_params.h"

namespace pileus {

/// Of one colour on both sides. `number` counts them as the files do: of two at one distance the
/// lower one is hit.
struct SolidTriangle {
    float corner[3][3];
    float normal[3];  ///< unit
    std::int32_t number, solid;
    std::int32_t colour;  ///< its row of `albedo`
    std::int32_t smooth;  ///< its row of `normals`, from 1; 0: flat
};

/// A box and what it holds: triangles [next, next + count), or where count <= 0 two nodes, the next
/// one in the list and number `next`; -count is the axis that parts them.
struct SolidNode {
    float low[3];
    std::int32_t next;
    float high[3];
    std::int32_t count;
};

/// Node 0 holds all. No triangles: nothing solid.
struct SolidsView {
    const SolidNode* nodes;
    const SolidTriangle* triangles;
    const float* albedo;   ///< [colour][3]
    const float* normals;  ///< [smooth - 1][corner][3], unit; null: all are flat
    std::int32_t count;    ///< triangles
    /// Metres after which all of it repeats along x and y, at least as wide as it is; 0: it stands
    /// once.
    float period[2];
};

/// Nodes on the way down at once: the builder keeps the tree lower.
constexpr int kSolidDepth = 72;

/// Most repetitions that a ray looks through: a level one between them would never come to an end.
constexpr int kMaxSolidCopies = 4096;

/// Rows of what lies behind the media where there are solids.
struct SolidRowsParams {
    BackgroundParams back;
    SolidsView solids;
    float around[3][kAroundTerms];  ///< see around_light
    float sun[3];                   ///< irradiance over pi
    SunHeights sun_heights;         ///< likewise, with rows in place of `sun`
};

}  // namespace pileus
