// SPDX-License-Identifier: Apache-2.0
// Settings of solid things: meshes, and maps of heights that become meshes.
// in: nothing -> out: plain structs with their defaults.
// docs/solids.md; docs/scene.md, "Solids".
#pragma once
#include <array>
#include <string>

#include "src/base/vectors.h"

namespace pileus {

/// Whether light takes a surface to be curved between its corners; kAuto: maps of heights are.
enum class SmoothUse { kAuto, kNo, kYes };

/// Numbers of a raw map of heights.
enum class HeightType { kInt16, kUint16, kFloat32 };

/// What becomes of samples without a height.
enum class HoleUse { kRefuse, kFill };

/// How the samples of a map of heights stand in the world.
struct HeightMapSettings {
    /// Corners, south-west and north-east, on which the outer samples lie; both the same: not
    /// given.
    std::array<std::array<double, 2>, 2> bounds_m{};
    std::array<double, 2>
        height_m{};                 ///< of integer samples 0 and all bits set; the same: not given
    std::array<int, 2> raw_size{};  ///< columns, rows
    HeightType raw_type = HeightType::kInt16;
    bool raw_big_endian = false;
    HoleUse holes = HoleUse::kRefuse;
    int every = 1;  ///< samples along each side whose mean is one of the mesh's
};

/// Sides and samples that a map may have.
constexpr int kMaxHeightSide = 32768;

/// A mesh of triangles that hides, is lit and casts shadows.
struct SolidSettings {
    std::string file;  ///< as MediumFile::file
    Float3 albedo{0.2f, 0.2f, 0.2f};
    std::string albedo_map;       ///< a picture seen from above, in place of albedo; empty: none
    double albedo_map_scale = 1;  ///< its values are multiplied by this
    Double3 position_m{}, rotation_deg{};  ///< turned about x, then y, then z
    double scale = 1;                      ///< metres per unit of the file
    bool y_up = false;                     ///< the file's y points up; glTF's always does
    SmoothUse smooth = SmoothUse::kAuto;
    HeightMapSettings heights;
};

}  // namespace pileus
