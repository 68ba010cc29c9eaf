// SPDX-License-Identifier: Apache-2.0
// Maps of heights from files that nobody has checked, and the meshes that they become.
// in: .png .exr .pfm .tif .hgt .raw and what the scene says of them -> out: triangles in metres.
// docs/solids.md, "Height maps".
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/buffer.h"
#include "src/base/limits.h"
#include "src/base/span.h"
#include "src/io/meshes/mesh_file.h"
#include "src/scene/media/solid_settings.h"

namespace pileus {

/// Samples as a file has them, rows from the north.
struct HeightGrid {
    int columns = 0, rows = 0;
    Buffer<float> height;   ///< [row][column]; NaN: a hole
    double full_scale = 0;  ///< of whole numbers that a range may stand for; 0: heights as they are
    bool placed = false;    ///< the file says where its outer samples lie
    std::array<std::array<double, 2>, 2> bounds_m{};
};

/// Reads a map and makes a mesh of it, with normals: in metres, its x and y those of the world
/// before they are turned or moved. Missing, malformed, with holes where these are refused:
/// kBadInput; over the limits `file`, `triangles` and `memory`, or out of memory: kLimit.
Status read_height_map(const std::string& path, const SolidSettings& settings, const Limits& limits,
                       Mesh& mesh);

/// The same from the bytes of a file; `extension` says which kind.
Status decode_height_map(const std::string& name, const std::string& extension,
                         Span<const char> bytes, const SolidSettings& settings,
                         std::uint64_t max_triangles, Mesh& mesh);

/// Triangles that a file of so many bytes may become, from its head alone; the largest number where
/// that does not say. Faults of read_file_start.
Status bound_heights(const std::string& path, std::uint64_t bytes,
                     const HeightMapSettings& settings, std::uint64_t& triangles);

/// Takes the size of a map and makes room for its samples: at least 2 x 2, what is left of them
/// within the limit of triangles, and the bytes within that of memory.
Status size_heights(const std::string& name, std::int64_t columns, std::int64_t rows,
                    const HeightMapSettings& settings, std::uint64_t max_triangles,
                    HeightGrid& grid);

/// Samples of the mesh along a side of so many.
inline int height_posts(std::int64_t samples, int every) {
    return int((samples + every - 1) / every);
}

/// Finds holes and heights that are none: kBadInput, unless they are to be filled. Fills them.
Status settle_holes(const std::string& name, HoleUse use, HeightGrid& grid);

/// Triangles and normals of a grid without holes.
Status mesh_of_heights(const std::string& name, const SolidSettings& settings,
                       const HeightGrid& grid, Mesh& mesh);

// One file per kind of file.
using DecodeHeights = Status(const std::string& name, Span<const char> bytes,
                             const HeightMapSettings& settings, std::uint64_t max_triangles,
                             HeightGrid& grid);
DecodeHeights decode_png_heights, decode_exr_heights, decode_pfm_heights, decode_tiff_heights,
    decode_hgt_heights, decode_raw_heights;

}  // namespace pileus
