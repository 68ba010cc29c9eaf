// SPDX-License-Identifier: Apache-2.0
// The planes of one tile in scratch memory: laid out, emptied, written to the image.
// in: BlendParams, the number of a tile -> out: planes that stay in the nearest caches.
// docs/methods.md 3, each image frame, step 5.
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/display/blend_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN T blend_load(const float* from) {
    T v;
    __builtin_memcpy(&v, from, sizeof(T));
    return v;
}
template <class T>
PILEUS_FN void blend_store(float* to, T v) {
    __builtin_memcpy(to, &v, sizeof(T));
}

/// The planes of one tile. `columns` holds each column's image plane coordinate, `alive` a word per
/// row: which of its blocks have a pixel that can take light. `depths` and `places` list the
/// vectors of pixels that one sphere touches in up to kBlendBlock rows, and where in a plane they
/// lie.
struct BlendTile {
    std::int32_t x, y, width, height, stride;
    std::size_t plane;
    float *transmittance, *half, *inverse, *opaque, *columns, *depths, *colour;
    std::uint32_t* alive;
    std::int32_t* places;
};

PILEUS_FN float blend_row_coordinate(const BlendParams& p, std::int32_t y) {
    return (1.0f - (float(y) + 0.5f) * (2.0f / float(p.height))) * p.half_height;
}

PILEUS_FN BlendTile blend_tile_at(const BlendParams& p, const BlendBuffers& b, std::uint32_t i) {
    BlendTile t{};
    t.x = std::int32_t(i % std::uint32_t(p.tiles_x)) * p.tile_width;
    t.y = std::int32_t(i / std::uint32_t(p.tiles_x)) * p.tile_height;
    t.width = p.width - t.x < p.tile_width ? p.width - t.x : p.tile_width;
    t.height = p.height - t.y < p.tile_height ? p.height - t.y : p.tile_height;
    t.stride = blend_row_stride(p.tile_width);
    t.plane = std::size_t(t.stride) * std::size_t(p.tile_height);
    t.transmittance = b.scratch;
    t.half = t.transmittance + t.plane;
    t.inverse = t.half + t.plane;
    t.opaque = t.inverse + t.plane;
    t.colour = t.opaque + t.plane;
    t.columns = t.colour + t.plane * std::size_t(p.channels);
    t.depths = t.columns + t.stride;
    t.places = reinterpret_cast<std::int32_t*>(t.depths + t.stride * kBlendBlock);
    t.alive = reinterpret_cast<std::uint32_t*>(t.places + t.stride * kBlendBlock);
    return t;
}

/// Empties the planes. Lanes beyond the image start opaque, so that they never keep a block alive.
template <class T>
PILEUS_FN void blend_clear(const BlendParams& p, const BlendBuffers& b, const BlendTile& t) {
    constexpr int w = width_of<T>;
    const T column = to_float(iota<I_of<T>>());
    for (std::int32_t x = 0; x < t.stride; x += w) {
        const T sx = ((column + (float(t.x + x) + 0.5f)) * (2.0f / float(p.width)) - 1.0f);
        blend_store(t.columns + x, sx * p.half_width);
    }
    const std::int32_t blocks = (t.width + kBlendBlock - 1) / kBlendBlock;
    for (std::int32_t y = 0; y < t.height; ++y) {
        const float sy = blend_row_coordinate(p, t.y + y);
        const std::size_t row = std::size_t(y) * std::size_t(t.stride);
        t.alive[y] = 0xffffffffu >> (32 - blocks);
        for (std::int32_t x = 0; x < t.stride; x += w) {
            const T sx = blend_load<T>(t.columns + x);
            const T inverse =
                p.orthographic ? all<T>(1.0f) : 1.0f / sqrt_(sx * sx + (sy * sy + 1.0f));
            const std::size_t at = row + std::size_t(x);
            blend_store(t.inverse + at, inverse);
            blend_store(t.transmittance + at,
                        select(column + float(x) < float(t.width), all<T>(1.0f), T{}));
            if (b.half_depth != nullptr) blend_store(t.half + at, all<T>(__builtin_inff()));
            for (std::int32_t k = 0; k < p.channels; ++k)
                blend_store(t.colour + t.plane * std::size_t(k) + at, T{});
        }
        if (b.opaque_depth) {
            const std::size_t from = std::size_t(t.y + y) * std::size_t(p.width);
            __builtin_memcpy(t.opaque + row, b.opaque_depth + from + std::size_t(t.x),
                             std::size_t(t.width) * sizeof(float));
        }
    }
}

/// Nearest solid in the tile, metres; infinity where there is none.
PILEUS_FN float blend_nearest_solid(const BlendBuffers& b, const BlendTile& t) {
    float least = __builtin_inff();
    if (b.opaque_depth == nullptr) return least;
    for (std::int32_t y = 0; y < t.height; ++y)
        for (std::int32_t x = 0; x < t.width; ++x)
            least = min_(t.opaque[std::size_t(y) * std::size_t(t.stride) + std::size_t(x)], least);
    return least;
}

/// Copies one row of a plane to the image, past the caches where it lies evenly.
template <class T>
PILEUS_FN void blend_copy(float* to, const float* from, std::int32_t count) {
    const bool even =
        (reinterpret_cast<std::uintptr_t>(to) | (std::uintptr_t(count) * 4)) % sizeof(T) == 0;
    if (!even) {
        __builtin_memcpy(to, from, std::size_t(count) * sizeof(float));
        return;
    }
    for (std::int32_t x = 0; x < count; x += width_of<T>) stream_(to + x, blend_load<T>(from + x));
}

template <class T>
PILEUS_FN void blend_write(const BlendParams& p, const BlendBuffers& b, const BlendTile& t) {
    const std::size_t image = std::size_t(p.width) * std::size_t(p.height);
    for (std::int32_t y = 0; y < t.height; ++y) {
        const std::size_t from = std::size_t(y) * std::size_t(t.stride);
        const std::size_t to = std::size_t(t.y + y) * std::size_t(p.width) + std::size_t(t.x);
        blend_copy<T>(b.transmittance + to, t.transmittance + from, t.width);
        if (b.half_depth != nullptr) blend_copy<T>(b.half_depth + to, t.half + from, t.width);
        for (std::size_t k = 0; k < std::size_t(p.channels); ++k)
            blend_copy<T>(b.colour + k * image + to, t.colour + k * t.plane + from, t.width);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
