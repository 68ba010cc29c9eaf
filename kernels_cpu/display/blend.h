// SPDX-License-Identifier: Apache-2.0
// Blends billboards (spheres of constant extinction and colour) front to back, tile by tile.
// in: spheres and a list per tile -> out: transmittance, premultiplied colour, half depth.
// docs/methods.md 3, each image frame, step 5: alpha = 1 - exp(-extinction chord). The same bits
// for every width and size of tiles: every pixel sees every sphere that touches it in order.
#pragma once
#include "kernels_cpu/display/blend_layer.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What all pixels of one sphere in one tile have in common.
struct BlendStrip {
    float colour[kMaxBlendChannels];
    float depth_scale;  ///< optical depth, of the part that is doubled, per sqrt(q) / |ray|
    float per_metre;    ///< the same per metre
    bool solid, half;   ///< a solid may cut chords; half depths are wanted
};

/// Up to kBlendBlock rows of one ellipse: q in the middle, the middle, blocks [first, end).
struct BlendRows {
    float q[kBlendBlock], middle[kBlendBlock];
    std::int32_t first[kBlendBlock], end[kBlendBlock];
};

/// Fills the rows from tile row `y` on, W at a time.
template <int W>
PILEUS_FN void blend_rows(const BlendTile& t, const BlendSphere& s, std::int32_t y, BlendRows& r) {
    using T = F<W>;
    using II = I<W>;
    constexpr float kFar = 0x1p23f;
    for (std::int32_t i = 0; i < kBlendBlock; i += W) {
        const T dy = to_float(iota<II>() + (t.y + y + i - s.row)) - s.row_part;
        const T q = 1.0f - s.ey * dy * dy;
        const T middle = s.lean * dy + s.column_part;

        // Leave out what surely lies beyond the rim: a hundredth of a pixel outweighs rounding.
        const T side = sqrt_(select(q > 0.0f, q, T{})) * s.reach + 0.01f;
        const auto pixel = [&](T at) {
            const II x = floor_int(min_(max_(at, all<T>(-kFar)), all<T>(kFar))) + 1;
            return min_(max_(x + (s.column - t.x), II{}), all<II>(t.width));
        };
        const II first = pixel(middle - side) >> 4;
        const II end = select(q > 0.0f, (pixel(middle + side) + (kBlendBlock - 1)) >> 4, II{});
        __builtin_memcpy(r.q + i, &q, sizeof(T));
        __builtin_memcpy(r.middle + i, &middle, sizeof(T));
        __builtin_memcpy(r.first + i, &first, sizeof(T));
        __builtin_memcpy(r.end + i, &end, sizeof(T));
    }
}

/// Optical depth (of the part that is doubled) of W pixels at a square root of q.
template <class T>
PILEUS_FN T blend_depth(const BlendParams& p, const BlendTile& t, const BlendSphere& s,
                        const BlendStrip& k, T root, std::int32_t y, std::int32_t x,
                        std::size_t at) {
    const T inverse = blend_load<T>(t.inverse + at);
    const T depth = root * (inverse * k.depth_scale);
    if (!k.solid) return depth;

    // Where nothing is cut the bits stay those of the plain depth.
    const T h = root * (inverse * s.half_scale);
    const T ahead = blend_load<T>(t.opaque + at) - blend_centre(p, t, s, y, x, inverse);
    const T cut = blend_chord_to_solid(h, T{} - h, ahead) * k.per_metre;
    return select(ahead < h, cut, depth);
}

/// Lists the vectors of one row's wanted blocks that the ellipse touches, from place `n` on.
template <int W>
PILEUS_FN std::int32_t blend_list_row(const BlendParams& p, const BlendTile& t,
                                      const BlendSphere& s, const BlendStrip& k,
                                      std::uint32_t wanted, std::int32_t y, float row_q,
                                      float middle, std::int32_t n) {
    using T = F<W>;
    const T lanes = to_float(iota<I<W>>());
    for (; wanted != 0; wanted &= wanted - 1) {
        const std::int32_t x = lowest_bit(wanted) * kBlendBlock;
        for (std::int32_t v = x; v < x + kBlendBlock; v += W) {
            const std::int32_t at = y * t.stride + v;
            const T dx = (lanes + float(t.x + v - s.column)) - middle;
            const T q = row_q - s.ex * dx * dx;
            const auto touched = q > 0.0f;
            if (W < kBlendBlock && !any(touched)) continue;
            const T root = sqrt_(select(touched, q, T{}));
            blend_store(t.depths + n * W, blend_depth(p, t, s, k, root, y, v, std::size_t(at)));
            t.places[n++] = at;
        }
    }
    return n;
}

/// Sets the half depth of W pixels, in the `halved` lanes, at a place of the tile's planes.
template <int W>
PILEUS_FN void blend_half_at(const BlendParams& p, const BlendTile& t, const BlendSphere& s,
                             F<W> before, M<W> halved, std::int32_t at) {
    using T = F<W>;
    const std::int32_t y = at / t.stride, x = at % t.stride;
    const float dy = float(t.y + y - s.row) - s.row_part;
    const T dx =
        (to_float(iota<I<W>>()) + float(t.x + x - s.column)) - (s.lean * dy + s.column_part);
    const T q = (1.0f - s.ey * dy * dy) - s.ex * dx * dx;
    const T inverse = blend_load<T>(t.inverse + at);
    const T h = sqrt_(select(q > 0.0f, q, T{})) * (inverse * s.half_scale);
    blend_half(t, s, blend_centre(p, t, s, y, x, inverse), BlendChord<T>{T{} - h, h + h}, before,
               halved, std::size_t(at));
}

/// Takes a block off the row's list once none of its pixels can take light.
template <int W>
PILEUS_FN void blend_retire(const BlendParams& p, const BlendTile& t, std::int32_t at) {
    const std::int32_t first = at / kBlendBlock * kBlendBlock;
    for (std::int32_t v = 0; v < kBlendBlock; v += W)
        if (any(blend_load<F<W>>(t.transmittance + first + v) >= p.cut)) return;
    t.alive[at / t.stride] &= ~(1u << (at % t.stride / kBlendBlock));
}

/// Takes the light of the `n` vectors listed.
template <int W, int C>
PILEUS_FN void blend_listed(const BlendParams& p, const BlendTile& t, const BlendSphere& s,
                            const BlendStrip& k, std::int32_t n) {
    using T = F<W>;
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t at = t.places[i];
        const T before = blend_load<T>(t.transmittance + at);
        const auto open = before >= p.cut;
        if (W < kBlendBlock && !any(open)) continue;
        const T depth = select(open, blend_load<T>(t.depths + i * W), T{});
        const T after =
            blend_take<T, C>(t, k.colour, p.channels, std::size_t(at), before, depth, s.doublings);
        if (!any(after >= p.cut)) blend_retire<W>(p, t, at);
        if (!k.half) continue;
        const auto halved = (before > 0.5f) & (after <= 0.5f);
        if (any(halved)) blend_half_at<W>(p, t, s, before, halved, at);
    }
}

/// One ellipse over the blocks of the tile that it may touch and that still take light. All depths
/// of some rows first: two short chains of arithmetic overlap better than one.
template <int W, int C>
PILEUS_FN void blend_ellipse(const BlendParams& p, const BlendTile& t, const BlendSphere& s,
                             const BlendStrip& k) {
    const std::int32_t y0 = s.y0 > t.y ? s.y0 - t.y : 0;
    const std::int32_t y1 = s.y1 - t.y < t.height ? s.y1 - t.y : t.height;
    const std::uint64_t one = 1;
    BlendRows rows;
    for (std::int32_t from = y0; from < y1; from += kBlendBlock) {
        blend_rows<W>(t, s, from, rows);
        const std::int32_t count = y1 - from < kBlendBlock ? y1 - from : kBlendBlock;
        std::int32_t n = 0;
        for (std::int32_t i = 0; i < count; ++i) {
            const std::uint64_t before = (one << rows.first[i]) - 1,
                                until = (one << rows.end[i]) - 1;
            const std::uint32_t wanted = std::uint32_t(until & ~before) & t.alive[from + i];
            n = blend_list_row<W>(p, t, s, k, wanted, from + i, rows.q[i], rows.middle[i], n);
        }
        blend_listed<W, C>(p, t, s, k, n);
    }
}

/// The ways of W rays of tile row `y` through a sphere close to the camera: from the cross product
/// of centre and ray, no difference of squares, cut at the camera and at the solid.
template <class T>
PILEUS_FN BlendChord<T> blend_near_chord(const BlendParams& p, const BlendTile& t,
                                         const BlendSphere& s, bool solid, T before, std::int32_t y,
                                         std::int32_t x, std::size_t at) {
    const float sy = blend_row_coordinate(p, t.y + y);
    const T sx = blend_load<T>(t.columns + x), inverse = blend_load<T>(t.inverse + at);
    const float a = p.orthographic ? s.y - sy : s.y - s.z * sy;
    const T u = p.orthographic ? sx - s.x : s.z * sx - s.x;
    const T v = p.orthographic ? T{} : s.x * sy - s.y * sx;
    const T h2 = s.radius_squared - (a * a + u * u + v * v) * (inverse * inverse);
    const auto touched = (h2 > 0.0f) & (before >= p.cut);
    const T h = sqrt_(select(touched, h2, T{}));
    const T centre = blend_centre(p, t, s, y, x, inverse);
    const T low = max_(T{} - h, T{} - centre);
    const T ahead = solid ? blend_load<T>(t.opaque + at) - centre : h;
    return {low, blend_chord_to_solid(h, low, ahead)};
}

/// One sphere close to the camera over its rectangle in the tile.
template <int W>
PILEUS_FN void blend_near(const BlendParams& p, const BlendTile& t, const BlendSphere& s,
                          const BlendStrip& k) {
    using T = F<W>;
    const std::int32_t x0 = s.x0 > t.x ? (s.x0 - t.x) / W * W : 0;
    const std::int32_t x1 = s.x1 - t.x < t.width ? s.x1 - t.x : t.width;
    const std::int32_t y0 = s.y0 > t.y ? s.y0 - t.y : 0;
    const std::int32_t y1 = s.y1 - t.y < t.height ? s.y1 - t.y : t.height;
    for (std::int32_t y = y0; y < y1; ++y)
        for (std::int32_t x = x0; x < x1; x += W) {
            if (((t.alive[y] >> (x / kBlendBlock)) & 1u) == 0) continue;
            const std::size_t at = std::size_t(y) * std::size_t(t.stride) + std::size_t(x);
            const T before = blend_load<T>(t.transmittance + at);
            const BlendChord<T> c = blend_near_chord<T>(p, t, s, k.solid, before, y, x, at);
            const T depth = c.length * k.per_metre;
            if (!any(depth > 0.0f)) continue;
            const T after =
                blend_take<T, 0>(t, k.colour, p.channels, at, before, depth, s.doublings);
            const auto halved = (before > 0.5f) & (after <= 0.5f);
            if (!k.half || !any(halved)) continue;
            const T inverse = blend_load<T>(t.inverse + at);
            blend_half(t, s, blend_centre(p, t, s, y, x, inverse), c, before, halved, at);
        }
}

/// One sphere over the part of its rectangle that lies in the tile.
template <int W>
PILEUS_FN void blend_sphere(const BlendParams& p, const BlendBuffers& b, const BlendTile& t,
                            const BlendSphere& s, float nearest_solid) {
    BlendStrip k;
    for (std::int32_t i = 0; i < p.channels; ++i)
        k.colour[i] = b.sphere_colour[std::size_t(i) * p.colour_stride + s.index];
    const std::int32_t halvings = s.doublings > kMaxDoublings ? 0 : s.doublings;
    k.per_metre = s.extinction * reinterpret<float>((127 - halvings) << 23);
    k.depth_scale = min_(2.0f * k.per_metre * s.half_scale, 1e30f);
    k.solid = s.far > nearest_solid;
    k.half = b.half_depth != nullptr;
    if (s.kind == kBlendNear)
        blend_near<W>(p, t, s, k);
    else if (p.channels == 3)
        blend_ellipse<W, 3>(p, t, s, k);
    else
        blend_ellipse<W, 0>(p, t, s, k);
}

/// Whether any pixel of the tile can still take light.
PILEUS_FN bool blend_alive(const BlendTile& t) {
    std::uint32_t alive = 0;
    for (std::int32_t y = 0; y < t.height; ++y) alive |= t.alive[y];
    return alive != 0;
}

/// Blends the tiles [begin, end) of the image. A tile ends early once all its pixels are opaque.
template <int W>
PILEUS_FN void blend_tile(const BlendParams& params, const BlendBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    const BlendParams p = params;  // a copy, which no store to a plane can seem to change
    constexpr std::uint64_t kLook = 32, kAhead = 4;
    for (std::uint32_t i = begin; i < end; ++i) {
        const BlendTile tile = blend_tile_at(p, b, i);
        blend_clear<F<W>>(p, b, tile);
        const float solid = blend_nearest_solid(b, tile);
        const std::uint64_t first = b.tile_begin[i], last = b.tile_begin[i + 1];
        for (std::uint64_t k = first; k < last; ++k) {
            if ((k - first) % kLook == kLook - 1 && !blend_alive(tile)) break;
            const BlendSphere s = b.spheres[b.tile_spheres[k]];
            if (k + kAhead < last) prefetch_(b.spheres + b.tile_spheres[k + kAhead]);
            blend_sphere<W>(p, b, tile, s, solid);
        }
        blend_write<F<W>>(p, b, tile);
    }
    end_stream();
}

}  // namespace PILEUS_ISA
}  // namespace pileus
