// SPDX-License-Identifier: Apache-2.0
// Reads a packed noise volume: trilinear, periodic, in the level that steps of a width can show.
// in: NoiseView, places in tiles -> out: values, what a level has lost, bounds over blocks.
// docs/skies.md, "Reading": two gathers for eight corners; levels by the sampling theorem.
#pragma once
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/procedural/sky_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The level that steps show, and the share of the next coarser one: texels no finer than steps.
template <class T>
struct NoiseLevel {
    I_of<T> level;
    T blend;
};
template <class T>
PILEUS_FN NoiseLevel<T> noise_level(const NoiseView& v, T width) {
    using II = I_of<T>;
    const T texels = max_(width * (v.per_m * float(v.size)), all<T>(1.0f));
    const II bits = reinterpret<II>(texels);
    const II level = min_((bits >> 23) - 127, all<II>(v.last));
    const T rest = reinterpret<T>((bits & 0x7fffff) | 0x3f800000) - 1.0f;
    return {level, select(level < v.last, max_(4.0f * rest - 3.0f, T{}), T{})};
}

/// Place in tiles, within [0, 1]; what lies 2^22 tiles away or farther counts as that far.
template <class T>
PILEUS_FN T tile_place(const NoiseView& v, T metres, int axis) {
    const T most = all<T>(0x1p22f);
    const T at = min_(max_(metres * v.per_m + v.offset[axis], T{} - most), most);
    return at - to_float(floor_int(at));
}
/// Along the axes of the tile, which is turned about the vertical.
template <class T>
PILEUS_FN Vec<T> to_tile(const NoiseView& v, const Vec<T>& p) {
    if (v.turn[1] == 0.0f) return p;
    return {v.turn[0] * p.x + v.turn[1] * p.y, v.turn[0] * p.y - v.turn[1] * p.x, p.z};
}
template <class T>
PILEUS_FN Vec<T> tile_place(const NoiseView& v, const Vec<T>& p) {
    return {tile_place(v, p.x, 0), tile_place(v, p.y, 1), tile_place(v, p.z, 2)};
}

/// The four corners of a word, weighed.
template <class T>
PILEUS_FN T word_value(I_of<T> word, T fx, T fy) {
    const auto corner = [&](int shift) { return to_float((word >> shift) & 255); };
    const T a = corner(0), c = corner(16);
    const T low = a + (corner(8) - a) * fx, high = c + (corner(24) - c) * fx;
    return low + (high - low) * fy;
}

/// Value 0..255 at a place in tiles, of the level with 2^bits texels along an edge.
template <class T>
PILEUS_FN T read_level(const NoiseView& v, const Vec<T>& place, I_of<T> bits) {
    using II = I_of<T>;
    const II m = all<II>(1) << bits, mask = m - 1;
    const T side = to_float(m), before = side - 0.5f;  // a tile more keeps all above zero
    const T x = place.x * side + before, y = place.y * side + before, z = place.z * side + before;
    const II ix = to_int(x), iy = to_int(y), iz = to_int(z);
    const II twice = bits + bits, start = (m << twice) >> 2;  // noise_level_start
    const II in_slice = start + ((iy & mask) << bits) + (ix & mask);
    const T fx = x - to_float(ix), fy = y - to_float(iy), fz = z - to_float(iz);
    const T low = word_value(gather(v.words, in_slice + ((iz & mask) << twice)), fx, fy);
    const T high = word_value(gather(v.words, in_slice + (((iz + 1) & mask) << twice)), fx, fy);
    return low + (high - low) * fz;
}

/// Variance that a level shows no more.
template <class T>
PILEUS_FN T lost_at(const NoiseView& v, const NoiseLevel<T>& at) {
    if (!any((at.level > 0) | (at.blend > 0.0f))) return T{};
    const T here = gather(v.lost, at.level);
    const T next = gather(v.lost, min_(at.level + 1, all<I_of<T>>(v.last)));
    return here + (next - here) * at.blend;
}

/// A noise at a place, times its share, and the variance of what its level no longer shows.
template <class T>
struct NoiseValue {
    T value, lost;
};
template <class T>
PILEUS_FN NoiseValue<T> read_noise(const NoiseView& v, const Vec<T>& p, T width) {
    using II = I_of<T>;
    const NoiseLevel<T> at = noise_level(v, width);
    const Vec<T> place = tile_place(v, to_tile(v, p));
    T value = read_level(v, place, v.last - at.level);
    if (any(at.blend > 0.0f)) {
        const II next = min_(at.level + 1, all<II>(v.last));
        const T coarse = read_level(v, place, v.last - next);
        value = value + (coarse - value) * at.blend;
    }
    return {value * v.share, lost_at(v, at)};
}

/// Largest value in the block around a place, of all levels up to that of a width, and metres to
/// the block's end; blocks are `raise` levels larger than they need be.
template <class T>
struct NoiseBound {
    T bound, rest;
};
template <class T>
PILEUS_FN NoiseBound<T> noise_ahead(const NoiseView& v, const Vec<T>& at, const Vec<T>& way,
                                    T width, std::int32_t raise) {
    const Vec<T> p = to_tile(v, at), d = to_tile(v, way);
    using II = I_of<T>;
    const II level = min_(noise_level(v, width).level + raise, all<II>(v.last));
    const II m = all<II>(v.size) >> level;
    const II blocks = select(m >= kNoiseBlock, m / kNoiseBlock, all<II>(1));
    const T side = to_float(blocks);
    const Vec<T> place = tile_place(v, p);
    const auto index = [&](T t) { return min_(to_int(t * side), blocks - 1); };
    const II x = index(place.x), y = index(place.y), z = index(place.z);
    const T metres = 1.0f / (side * v.per_m);
    const auto rest = [&](II i, T t, T direction) {
        const auto forward = direction >= 0.0f;
        const T face = to_float(select(forward, i + 1, i));
        const T at_block = t * side;
        return select(forward, face - at_block, at_block - face) * metres /
               max_(abs_(direction), all<T>(1e-18f));
    };
    const T near = min_(rest(x, place.x, d.x), rest(y, place.y, d.y));
    const T t = min_(near, rest(z, place.z, d.z));
    const II start = (blocks * blocks * blocks) >> 2;
    const II number = start + (z * blocks + y) * blocks + x;
    const II largest = gather(v.largest, number >> 2) >> ((number & 3) << 3);
    return {to_float(largest & 255) * v.share, max_(t, T{})};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
