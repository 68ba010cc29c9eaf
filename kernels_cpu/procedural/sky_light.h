// SPDX-License-Identifier: Apache-2.0
// Nodes of sunlight in a layer, in levels around the camera: where they lie, and how they are read.
// in: SkyLightView, places in box-local metres -> out: optical depths towards the sun.
// docs/skies.md, "Sunlight on nodes".
#pragma once
#include "kernels_cpu/procedural/sky_layer.h"

namespace pileus {
inline namespace PILEUS_ISA {

PILEUS_FN std::int32_t sky_light_row_start(const SkyLightView& v, std::int32_t level,
                                           std::int32_t height, std::int32_t row) {
    const std::int32_t slice = level * kSkyLightHeights + height;
    return (slice << (2 * v.bits)) + ((row & ((1 << v.bits) - 1)) << v.bits);
}

/// A place at a share of the layer's height, within the box where there is one.
template <class T>
PILEUS_FN Vec<T> sky_light_place(const SkyParams& k, T x, T y, float share) {
    if (k.boxed != 0) {
        x = min_(max_(x, T{}), all<T>(k.extent_m[0]));
        y = min_(max_(y, T{}), all<T>(k.extent_m[1]));
    }
    const float h = k.low_m + share * k.height_m;
    T z = all<T>(h);
    if (k.curvature_per_m > 0.0f) {
        // z + (x^2 + y^2 + z^2) / 2R is the altitude's u.
        const T wx = x + k.shift_m[0], wy = y + k.shift_m[1];
        const T c = lifted_altitude(k, h) - 0.5f * k.curvature_per_m * (wx * wx + wy * wy);
        z = 2.0f * c / (1.0f + sqrt_(max_(1.0f + 2.0f * k.curvature_per_m * c, T{})));
    }
    return {x, y, z - k.shift_m[2]};
}

/// The two depths of a word, mixed.
template <class T>
PILEUS_FN T sky_light_pair(I_of<T> word, T f) {
    const T low = to_float(word & 0xffff), high = to_float((word >> 16) & 0xffff);
    return low + (high - low) * f;
}

/// Trilinear in one level, in units of kSkyLightUnit; x and y in spacings, z in nodes.
template <class T>
PILEUS_FN T read_sky_light(const SkyLightView& v, T x, T y, T z, I_of<T> level) {
    using II = I_of<T>;
    const II ix = floor_int(x), iy = floor_int(y);
    const II iz = min_(to_int(z), all<II>(kSkyLightHeights - 2));
    const T fx = x - to_float(ix), fy = y - to_float(iy), fz = z - to_float(iz);
    const std::int32_t mask = (1 << v.bits) - 1, slice = 1 << (2 * v.bits);
    const II at = ((level * kSkyLightHeights + iz) << (2 * v.bits)) + (ix & mask);
    const II row = (iy & mask) << v.bits, next = ((iy + 1) & mask) << v.bits;
    const auto read = [&](II place) { return sky_light_pair(gather(v.words, place), fx); };
    const T a = read(at + row), b = read(at + next);
    const T c = read(at + row + slice), d = read(at + next + slice);
    const T low = a + (b - a) * fy, high = c + (d - c) * fy;
    return low + (high - low) * fz;
}

/// What nodes hold of the optical depth to the sun. A level is read within its reach, and blends to
/// the next one over the last eighth of it, so that nothing pops.
template <class T>
PILEUS_FN T sky_sun_depth(const SkyParams& k, const SkyLightView& v, const Vec<T>& p) {
    using II = I_of<T>;
    const float last = v.reach_m * float(1 << (v.levels - 1));
    const T dx = min_(max_(p.x - v.camera[0], all<T>(-last)), all<T>(last));
    const T dy = min_(max_(p.y - v.camera[1], all<T>(-last)), all<T>(last));
    const T share = (altitude(k, sky_world(k, p)) - k.low_m) * k.inverse_m;
    const T z = min_(max_(share, T{}), all<T>(1.0f)) * float(kSkyLightHeights - 1);
    const T far = max_(max_(abs_(dx), abs_(dy)) * (2.0f / v.reach_m), all<T>(1.0f));
    const II bits = reinterpret<II>(far);
    const II level = min_((bits >> 23) - 127, all<II>(v.levels - 1));
    const T rest = reinterpret<T>((bits & 0x7fffff) | 0x3f800000) - 1.0f;
    const T blend = select(level < v.levels - 1, max_(4.0f * rest - 3.0f, T{}), T{});
    // 2^-level
    const T scale = reinterpret<T>((127 - level) << 23) * (1.0f / v.spacing_m);
    const T x = (dx + v.camera[0]) * scale, y = (dy + v.camera[1]) * scale;
    T depth = read_sky_light(v, x, y, z, level);
    if (any(blend > 0.0f)) {
        const II next = min_(level + 1, all<II>(v.levels - 1));
        const T coarse = read_sky_light(v, 0.5f * x, 0.5f * y, z, next);
        depth = depth + (coarse - depth) * blend;
    }
    return depth * (1.0f / kSkyLightUnit);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
