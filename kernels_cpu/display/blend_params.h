// SPDX-License-Identifier: Apache-2.0
// What the blender of billboards reads and writes: plain structs, the layout a GPU launch takes.
// in: spheres as the camera sees them and a list per tile, front to back -> out: image planes.
// docs/methods.md 3, each image frame, step 5; memory stays with the caller.
#pragma once
#include <cstdint>

namespace pileus {

/// Most colour planes that one pass blends: RGB of the image and of 16 batch estimates.
constexpr std::int32_t kMaxBlendChannels = 3 * 17;
/// Below this transmittance a pixel takes no more light.
constexpr float kBlendCut = 1e-4f;
/// Pixels of a block, for every width of lanes: what is skipped as one once all are opaque.
constexpr std::int32_t kBlendBlock = 16;
/// Widest tile: a row's blocks fit the bits of one word.
constexpr std::int32_t kMaxTileWidth = 32 * kBlendBlock;
/// Planes of a tile besides its colours: transmittance, half depth, 1/|ray|, opaque depth.
constexpr std::int32_t kBlendPlanes = 4;
/// Thickest layer whose share has its own polynomial, and how often that share is doubled.
constexpr float kThinLayer = 0.35f;
constexpr std::int32_t kMaxDoublings = 4;

/// How a sphere is met by rays: as an ellipse on the screen, or close to the camera, one by one.
enum BlendKind : std::uint32_t { kBlendEllipse = 0, kBlendNear = 1 };

/// One sphere. Centre along the camera's right, up and forward, from its position, metres.
/// Pixels touched: columns [x0, x1), rows [y0, y1), a conservative rectangle inside the image.
/// An ellipse: dy = y - row - row_part, dx = x - column - (column_part + lean dy) in pixels, then
/// q = 1 - ey dy^2 - ex dx^2 and half of the chord is half_scale sqrt(q) / |ray| metres. `reach`:
/// columns from the middle to the rim where dy = 0, rounded up. `index` finds the colour.
/// `doublings`: of the share taken at 2^-doublings of the depth; above kMaxDoublings: by range.
struct BlendSphere {
    float x, y, z, radius_squared, extinction;
    float ex, ey, column_part, row_part, lean, reach, half_scale, far;
    std::int32_t column, row, x0, x1, y0, y1, doublings;
    std::uint32_t index, kind;
};

/// `half_width` and `half_height` as in CameraParams. Tiles are numbered in rows from the top.
/// `colour_stride` is the distance between the colour planes of the spheres, in floats.
struct BlendParams {
    std::int32_t width, height, tile_width, tile_height, tiles_x, channels;
    std::int32_t orthographic;
    std::uint32_t colour_stride;
    float half_width, half_height, cut;
};

/// List of tile i, front to back: tile_spheres[tile_begin[i] .. tile_begin[i+1]).
/// `scratch` holds blend_scratch_floats() floats and belongs to one thread, aligned to 64 bytes.
struct BlendBuffers {
    const BlendSphere* spheres;
    const float* sphere_colour;         // [channel][colour_stride]
    const std::uint64_t* tile_begin;    // tiles + 1
    const std::uint32_t* tile_spheres;  // places in `spheres`
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
constexpr std::int32_t blend_row_stride(std::int32_t tile_width) {
    return (tile_width + kBlendBlock - 1) / kBlendBlock * kBlendBlock;
}

/// Floats of scratch that one thread needs: all planes, a row of columns, two lists of kBlendBlock
/// rows, a word per row.
constexpr std::uint64_t blend_scratch_floats(const BlendParams& p) {
    const std::uint64_t row = std::uint64_t(blend_row_stride(p.tile_width));
    const std::uint64_t high = std::uint64_t(p.tile_height);
    return row * (high * std::uint64_t(kBlendPlanes + p.channels) + 1 + 2 * kBlendBlock) + high;
}

/// Floats from one thread's scratch to the next one's.
constexpr std::uint64_t blend_scratch_share(const BlendParams& p) {
    return (blend_scratch_floats(p) + 15) / 16 * 16;
}

}  // namespace pileus
