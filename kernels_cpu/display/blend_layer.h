// SPDX-License-Identifier: Apache-2.0
// What one layer of a sphere does to W pixels: its share of the light, what it leaves, its depth.
// in: optical depth, transmittance before -> out: planes of the tile.
// docs/methods.md 3, each image frame, step 5; errors in its table of functions.
#pragma once
#include "kernels_cpu/display/blend_tile.h"

namespace pileus {
inline namespace PILEUS_ISA {

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

/// 1 - e^-(depth 2^doublings) for depth <= kThinLayer, interpolated at Chebyshev's nodes; then
/// 1 - e^-2d = t (2 - t). Relative error <= 2^-22 at up to kMaxDoublings.
template <class T>
PILEUS_FN T layer_share(T depth, std::int32_t doublings) {
    const T square = depth * depth;
    const T low = 4.999998510e-1f - 1.666531563e-1f * depth;
    const T high = 4.147208482e-2f - 7.424637210e-3f * depth;
    T t = depth - square * (low + square * high);
    for (std::int32_t i = 0; i < doublings; ++i) t = t * (2.0f - t);
    return t;
}

/// `depth` as BlendSphere::doublings says. What is left is before - taken: right to 2^-24 before.
template <class T>
PILEUS_FN Attenuated<T> take_layer(T before, T depth, std::int32_t doublings) {
    if (doublings > kMaxDoublings) return attenuate(before, depth);
    const T taken = before * layer_share(depth, doublings);
    return {taken, before - taken};
}

/// Takes the light of one layer into W pixels of C colours (0: of `channels`); returns what is
/// left.
template <class T, int C>
PILEUS_FN T blend_take(const BlendTile& t, const float* colour, std::int32_t channels,
                       std::size_t at, T before, T depth, std::int32_t doublings) {
    const Attenuated<T> a = take_layer(before, depth, doublings);
    blend_store(t.transmittance + at, a.after);
    const std::int32_t count = C > 0 ? C : channels;
    for (std::int32_t k = 0; k < count; ++k) {
        float* c = t.colour + t.plane * std::size_t(k) + at;
        blend_store(c, blend_load<T>(c) + a.taken * colour[k]);
    }
    return a.after;
}

/// Where the sphere's centre lies along the rays of W pixels of tile row y, metres.
template <class T>
PILEUS_FN T blend_centre(const BlendParams& p, const BlendTile& t, const BlendSphere& s,
                         std::int32_t y, std::int32_t x, T inverse) {
    if (p.orthographic) return all<T>(s.z);
    const float row = s.y * blend_row_coordinate(p, t.y + y) + s.z;
    return (s.x * blend_load<T>(t.columns + x) + row) * inverse;
}

/// The way through a sphere, metres from its centre's place on the ray: from `low` on.
template <class T>
struct BlendChord {
    T low, length;
};

/// Cut by the solid of W pixels.
template <class T>
PILEUS_FN T blend_chord_to_solid(T half, T low, T to_solid) {
    return max_(min_(half, to_solid) - low, T{});
}

/// Sets the depth where before e^(-extinction s) = 1/2 inside this sphere, in the `halved` lanes.
template <class T, class Mask>
PILEUS_FN void blend_half(const BlendTile& t, const BlendSphere& s, T centre,
                          const BlendChord<T>& c, T before, Mask halved, std::size_t at) {
    const T along = log_(max_(before + before, all<T>(1.0f))) / s.extinction;
    const T depth = (centre + c.low) + min_(along, c.length);
    blend_store(t.half + at, select(halved, depth, blend_load<T>(t.half + at)));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
