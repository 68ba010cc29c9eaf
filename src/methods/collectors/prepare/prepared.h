// SPDX-License-Identifier: Apache-2.0
// What the preparation of method `collectors` leaves behind: samples, leaves, collectors.
// in: nothing -> out: plain structs, made once per animation frame, then read only.
// Elek 2011, sections 5.1-5.5; lengths are box-local: metres from the low corner of the box.
#pragma once
#include <cstdint>

namespace pileus {

/// A point drawn where the density changes.
struct Sample {
    float x[3];     ///< voxel coordinates, inside the box, never on a voxel's face
    float density;  ///< trilinear, at x
};

/// A box of whole voxels; all leaves together tile the grid.
struct Leaf {
    std::int32_t lo[3], hi[3];  ///< voxel faces, half-open
    float majorant;             ///< largest density over the trilinear footprint
    double mass;                ///< integral of the trilinear density over the leaf, m^3
    float filled;               ///< share of voxels that are not empty, [0, 1]
    std::int32_t collector;     ///< index, or -1 where the mass is 0
};

/// A sphere that stands for the medium of one leaf.
struct Collector {
    float centre[3];         ///< metres, box-local
    float radius;            ///< of the sphere with the leaf's volume, metres
    float billboard_radius;  ///< R >= radius, metres
    float extinction;        ///< mass / (4/3 pi R^3): relative density of the billboard
    double mass;             ///< of the leaf, m^3
    std::int32_t leaf;
};

}  // namespace pileus
