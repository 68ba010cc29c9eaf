// SPDX-License-Identifier: Apache-2.0
// The media's shadow of the sun on the ground, on nodes: many pixels ask for few places.
// in: a medium, the sun, a ground -> out: optical depths towards the sun on the ground.
// docs/collectors.md, "Light that needs no photon"
#pragma once
#include "src/picture/nodes/sun_slices.h"
#include "src/plan/array.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

/// Nodes lie a cell of the density apart, at places of their own whatever the sun.
struct GroundShadow {
    NodeGrid nodes{};   ///< size 0: every pixel looks for itself
    float origin[3]{};  ///< m, box-local
    double ground_z = 0;
    SunSlices slices;
    Buffer<float> depth;  ///< [y][x]
};

/// Most nodes for a picture of so many pixels, and what is allocated; 0 without a ground, and where
/// voxels of one density or a periodic medium have shadows of other edges.
std::uint64_t most_ground_nodes(const Medium& medium, const Lighting& lighting,
                                std::uint64_t pixels);

namespace arrays {

inline Array<float> ground_shadow(std::uint64_t nodes) {
    return {"shadow on the ground", nodes, Stage::kBackground, Stage::kWrite};
}

}  // namespace arrays

/// Makes what the sun or the ground has moved for, for the camera's whole picture. A low sun's
/// shadow, of more nodes than `most_ground_nodes`, is left to the pixels. kLimit: out of memory.
Status make_ground_shadow(const Context& context, const Medium& medium, const MediumView& view,
                          const Lighting& lighting, const CameraParams& camera, const SunTurn& turn,
                          GroundShadow& out);

/// The background reads it.
void read_ground_shadow(const GroundShadow& shadow, BackgroundParams& k, BackgroundBuffers& b);

}  // namespace pileus
