// SPDX-License-Identifier: Apache-2.0
// Blends billboards (spheres of constant extinction and colour) front to back, tile by tile.
// in: sorted spheres and a list per tile -> out: transmittance, premultiplied colour, half depth.
// docs/methods.md 3, each image frame, step 5: alpha = 1 - exp(-extinction chord). The same bits
// for every width and size of tiles: every pixel sees every sphere that touches it in order.
#pragma once
#include "kernels_cpu/blend_params.h"
#include "kernels_cpu/math.h"

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

/// What a layer takes from the transmittance and what it leaves.
template <class T>
struct Attenuated {
    T taken, after;
};

/// before (1 - e^-depth) and before e^-depth for depth >= 0, from one polynomial and without
/// cancellation: e^-depth = (1 + core) 2^-n, and where n = 0 the taken part is -core itself.
/// Relative error of each <= 2^-22 (the thickest layers leave exactly 0 from depth 87.7 on).
template <class T>
PILEUS_FN Attenuated<T> attenuate(T before, T depth) {
    const T x = min_(depth, all<T>(88.0f));
    const auto n = to_int(x * 1.44269504088896341f + 0.5f);
    const T nf = to_float(n);
    const T core = expm1_core((nf * 0.693359375f - x) - nf * 2.12194440e-4f);
    const T halved = before * reinterpret<T>((127 - n) << 23);
    const T change = halved * core;
    return {(before - halved) - change, halved + change};
}

/// The planes of one tile in scratch memory. Single rows: `columns` holds each column's image
/// plane coordinate, `depths` one sphere's optical depths.
struct BlendTile {
    std::int32_t x, y, width, height, stride;
    std::size_t plane;
    float *transmittance, *half, *inverse2, *opaque, *columns, *depths, *colour;
};

/// What one row of one sphere has in common: the cross product of centre and ray is
/// (sqrt(a2), bs sx - bo, co - cs sx), the centre's place along the ray (ts sx + to) / |ray|.
struct BlendRow {
    float a2, bs, bo, cs, co, ts, to;
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
    t.inverse2 = t.half + t.plane;
    t.opaque = t.inverse2 + t.plane;
    t.colour = t.opaque + t.plane;
    t.columns = t.colour + t.plane * std::size_t(p.channels);
    t.depths = t.columns + t.stride;
    return t;
}

/// Empties the planes. Lanes beyond the image start opaque, so that they never keep a tile alive.
template <class T>
PILEUS_FN void blend_clear(const BlendParams& p, const BlendBuffers& b, const BlendTile& t) {
    constexpr int w = width_of<T>;
    const T column = to_float(iota<I_of<T>>());
    for (std::int32_t x = 0; x < t.stride; x += w) {
        const T sx = ((column + (float(t.x + x) + 0.5f)) * (2.0f / float(p.width)) - 1.0f);
        blend_store(t.columns + x, sx * p.half_width);
    }
    for (std::int32_t y = 0; y < t.height; ++y) {
        const float sy = blend_row_coordinate(p, t.y + y);
        const std::size_t row = std::size_t(y) * std::size_t(t.stride);
        for (std::int32_t x = 0; x < t.stride; x += w) {
            const T sx = blend_load<T>(t.columns + x);
            const T inverse2 = 1.0f / (sx * sx + (sy * sy + 1.0f));
            const std::size_t at = row + std::size_t(x);
            blend_store(t.inverse2 + at, p.orthographic ? all<T>(1.0f) : inverse2);
            blend_store(t.transmittance + at,
                        select(column + float(x) < float(t.width), all<T>(1.0f), T{}));
            blend_store(t.half + at, all<T>(__builtin_inff()));
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

PILEUS_FN BlendRow blend_row(const BlendParams& p, const BlendSphere& s, float sy) {
    if (p.orthographic) {
        const float a = s.y - sy;
        return {a * a, 1.0f, s.x, 0.0f, 0.0f, 0.0f, s.z};
    }
    const float a = s.y - s.z * sy;
    return {a * a, s.z, s.x, s.y, s.x * sy, s.x, s.y * sy + s.z};
}

/// Where W rays meet a sphere: the way from its centre's place on the ray to the near end.
template <class T>
struct BlendChord {
    T low, chord;
};

/// `clip`: cut the chord at the camera and at the solid. Zero where the pixel takes no light.
template <class T>
PILEUS_FN BlendChord<T> blend_chord(const BlendParams& p, const BlendTile& t, const BlendSphere& s,
                                    const BlendRow& r, T before, bool clip, bool solid,
                                    std::size_t at, std::int32_t x) {
    // Take the distance of ray and centre from the cross product: no difference of squares.
    const T sx = blend_load<T>(t.columns + x);
    const T inverse2 = blend_load<T>(t.inverse2 + at);
    const T u = r.bs * sx - r.bo, v = r.co - r.cs * sx;
    const T h2 = s.radius_squared - (r.a2 + u * u + v * v) * inverse2;
    const auto touched = (h2 > 0.0f) & (before >= p.cut);
    if (!any(touched)) return {T{}, T{}};

    // Measure the chord from the centre's place along the ray, so that 2h stays exact.
    const T h = sqrt_(select(touched, h2, T{}));
    if (!clip) return {T{} - h, h + h};
    const T centre = (r.ts * sx + r.to) * sqrt_(inverse2);
    const T low = max_(T{} - h, T{} - centre);
    const T high = solid ? min_(h, blend_load<T>(t.opaque + at) - centre) : h;
    return {low, max_(high - low, T{})};
}

/// Takes the light of one sphere of optical depth `depth` into W pixels.
/// Returns the lanes whose transmittance falls to one half.
template <class T>
PILEUS_FN auto blend_take(const BlendTile& t, const float* colour, std::int32_t channels,
                          std::size_t at, T depth, T before) {
    const Attenuated<T> a = attenuate(before, depth);
    blend_store(t.transmittance + at, a.after);
    for (std::int32_t k = 0; k < channels; ++k) {
        float* c = t.colour + t.plane * std::size_t(k) + at;
        blend_store(c, blend_load<T>(c) + a.taken * colour[k]);
    }
    return (before > 0.5f) & (a.after <= 0.5f);
}

/// Sets the depth where before e^(-extinction s) = 1/2 inside this sphere, in the `halved` lanes.
template <class T, class Mask>
PILEUS_FN void blend_half(const BlendTile& t, const BlendSphere& s, const BlendRow& r,
                          const BlendChord<T>& c, T before, Mask halved, std::size_t at,
                          std::int32_t x) {
    const T sx = blend_load<T>(t.columns + x);
    const T centre = (r.ts * sx + r.to) * sqrt_(blend_load<T>(t.inverse2 + at));
    const T along = log_(max_(before + before, all<T>(1.0f))) / s.extinction;
    const T depth = (centre + c.low) + min_(along, c.chord);
    blend_store(t.half + at, select(halved, depth, blend_load<T>(t.half + at)));
}

/// One sphere over the part of its rectangle that lies in the tile.
template <class T>
PILEUS_FN void blend_sphere(const BlendParams& p, const BlendBuffers& b, const BlendTile& t,
                            const BlendSphere& s) {
    constexpr int w = width_of<T>;
    float colour[kMaxBlendChannels];
    for (std::int32_t k = 0; k < p.channels; ++k)
        colour[k] = b.sphere_colour[std::size_t(k) * p.colour_stride + s.index];
    const bool solid = b.opaque_depth != nullptr, clip = solid || s.clip != 0;
    const std::int32_t x0 = s.x0 > t.x ? (s.x0 - t.x) / w * w : 0;
    const std::int32_t x1 = s.x1 - t.x < t.width ? s.x1 - t.x : t.width;
    const std::int32_t y0 = s.y0 > t.y ? s.y0 - t.y : 0;
    const std::int32_t y1 = s.y1 - t.y < t.height ? s.y1 - t.y : t.height;
    for (std::int32_t y = y0; y < y1; ++y) {
        const BlendRow row = blend_row(p, s, blend_row_coordinate(p, t.y + y));
        const std::size_t start = std::size_t(y) * std::size_t(t.stride);

        // Find all depths of the row first: two short chains of arithmetic overlap better than one.
        for (std::int32_t x = x0; x < x1; x += w) {
            const std::size_t at = start + std::size_t(x);
            const T before = blend_load<T>(t.transmittance + at);
            const BlendChord<T> c = blend_chord<T>(p, t, s, row, before, clip, solid, at, x);
            blend_store(t.depths + x, s.extinction * c.chord);
        }
        for (std::int32_t x = x0; x < x1; x += w) {
            const T depth = blend_load<T>(t.depths + x);
            if (!any(depth > 0.0f)) continue;
            const std::size_t at = start + std::size_t(x);
            const T before = blend_load<T>(t.transmittance + at);
            const auto halved = blend_take<T>(t, colour, p.channels, at, depth, before);
            if (b.half_depth == nullptr || !any(halved)) continue;
            const BlendChord<T> c = blend_chord<T>(p, t, s, row, before, clip, solid, at, x);
            blend_half<T>(t, s, row, c, before, halved, at, x);
        }
    }
}

/// Whether any pixel of the tile can still take light.
template <class T>
PILEUS_FN bool blend_alive(const BlendParams& p, const BlendTile& t) {
    const std::size_t count = std::size_t(t.stride) * std::size_t(t.height);
    for (std::size_t i = 0; i < count; i += width_of<T>)
        if (any(blend_load<T>(t.transmittance + i) >= p.cut)) return true;
    return false;
}

PILEUS_FN void blend_write(const BlendParams& p, const BlendBuffers& b, const BlendTile& t) {
    const std::size_t bytes = std::size_t(t.width) * sizeof(float);
    const std::size_t image = std::size_t(p.width) * std::size_t(p.height);
    for (std::int32_t y = 0; y < t.height; ++y) {
        const std::size_t from = std::size_t(y) * std::size_t(t.stride);
        const std::size_t to = std::size_t(t.y + y) * std::size_t(p.width) + std::size_t(t.x);
        __builtin_memcpy(b.transmittance + to, t.transmittance + from, bytes);
        if (b.half_depth != nullptr) __builtin_memcpy(b.half_depth + to, t.half + from, bytes);
        for (std::size_t k = 0; k < std::size_t(p.channels); ++k)
            __builtin_memcpy(b.colour + k * image + to, t.colour + k * t.plane + from, bytes);
    }
}

/// Blends the tiles [begin, end) of the image. A tile ends early once all its pixels are opaque.
template <int W>
PILEUS_FN void blend_tile(const BlendParams& params, const BlendBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    const BlendParams p = params;  // a copy, which no store to a plane can seem to change
    constexpr std::uint64_t kLook = 32;
    for (std::uint32_t i = begin; i < end; ++i) {
        const BlendTile tile = blend_tile_at(p, b, i);
        blend_clear<F<W>>(p, b, tile);
        const std::uint64_t first = b.tile_begin[i], last = b.tile_begin[i + 1];
        for (std::uint64_t k = first; k < last; ++k) {
            if ((k - first) % kLook == kLook - 1 && !blend_alive<F<W>>(p, tile)) break;
            const BlendSphere s = b.spheres[b.tile_spheres[k]];
            blend_sphere<F<W>>(p, b, tile, s);
        }
        blend_write(p, b, tile);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
