// SPDX-License-Identifier: Apache-2.0
// What the blender of billboards reads and writes: plain structs, the layout a GPU launch takes.
// in: spheres in camera coordinates, front to back, and a list per tile -> out: image planes.
// docs/methods.md 3, each image frame, step 5; memory stays with the caller.
#pragma once
#include <cstdint>

namespace pileus {

/// Most colour planes that one pass blends: RGB of the image and of 16 batch estimates.
constexpr std::int32_t kMaxBlendChannels = 3 * 17;
/// Below this transmittance a pixel takes no more light.
constexpr float kBlendCut = 1e-4f;
/// Rows of a tile start at multiples of this many floats, for every width of lanes.
constexpr std::int32_t kBlendAlign = 16;
/// Planes of a tile besides its colours: transmittance, half depth, 1/|ray|^2, opaque depth.
constexpr std::int32_t kBlendPlanes = 4;

/// One sphere. Centre along the camera's right, up and forward, from its position, metres.
/// Pixels touched: columns [x0, x1), rows [y0, y1), a conservative rectangle inside the image.
/// `index` finds the colour; `clip` is 0 where the chord surely lies in front of the camera.
struct BlendSphere {
    float x, y, z, radius_squared, extinction;
    std::int32_t x0, x1, y0, y1;
    std::uint32_t index, clip;
};

/// `half_width` and `half_height` as in CameraParams. Tiles are numbered in rows from the top.
/// `colour_stride` is the distance between the colour planes of the spheres, in floats.
struct BlendParams {
    std::int32_t width, height, tile_width, tile_height, tiles_x, channels;
    std::int32_t orthographic;
    std::uint32_t colour_stride;
    float half_width, half_height, cut;
};

/// Spheres front to back; list of tile i: tile_spheres[tile_begin[i] .. tile_begin[i+1]).
/// `scratch` holds blend_scratch_floats() floats and belongs to one thread, aligned to 64 bytes.
struct BlendBuffers {
    const BlendSphere* spheres;
    const float* sphere_colour;         // [channel][colour_stride]
    const std::uint64_t* tile_begin;    // tiles + 1
    const std::uint32_t* tile_spheres;  // places in `spheres`, ascending
    const float* opaque_depth;          // [height][width] metres along the ray, or null
    float* transmittance;               // [height][width]
    float* half_depth;  // [height][width] metres along the ray, or infinity; or null
    float* colour;      // [channel][height][width]
    float* scratch;
};

/// Blends the tiles [begin, end).
using BlendFunction = void (*)(const BlendParams&, const BlendBuffers&, std::uint32_t,
                               std::uint32_t);

/// Floats from one row of a tile to the next.
inline std::int32_t blend_row_stride(std::int32_t tile_width) {
    return (tile_width + kBlendAlign - 1) / kBlendAlign * kBlendAlign;
}

/// Floats of scratch that one thread needs: all planes and two single rows.
inline std::uint64_t blend_scratch_floats(const BlendParams& p) {
    const std::uint64_t row = std::uint64_t(blend_row_stride(p.tile_width));
    return row * (std::uint64_t(p.tile_height) * std::uint64_t(kBlendPlanes + p.channels) + 2);
}

}  // namespace pileus
