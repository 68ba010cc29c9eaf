// SPDX-License-Identifier: Apache-2.0
// Light along a ray from nodes that hold harmonics of what goes each way.
// in: numbers of nodes, a ray -> out: what each of its places sends along it.
// docs/methods.md 3, each image frame, step 4; docs/collectors.md, "From within a medium".
#pragma once
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/display/lit_nodes.h"
#include "kernels_cpu/display/march_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The harmonics of the directions in which a ray's light travels, lane by lane; after the bands'
/// come for each axis the Legendre polynomials of the angle to it.
template <int W>
struct RayHarmonics {
    float y[W][kMaxHarmonics];
};

/// Those of one axis, straight along `way`, in the lanes of `bits`; light travels along `to`.
template <int W>
PILEUS_FN void set_axis(const MarchParams& k, const Vec<F<W>>& way, const Vec<F<W>>& to, int number,
                        std::uint32_t bits, RayHarmonics<W>& h) {
    F<W> p[kMaxAxisDegrees];
    axis_values(k.bands, k.degrees, 1.0f - one_minus_cosine(way, to), p);
    const int first = k.bands * k.bands + number * k.degrees;
    for (; bits != 0; bits &= bits - 1) {
        const int l = lowest_bit(bits);
        for (int i = 0; i < k.degrees; ++i) h.y[l][first + i] = lane(p[i], l);
    }
}

/// All but what differs from place to place: that is 0.
template <int W>
PILEUS_FN void set_harmonics(const MarchParams& k, const Vec<F<W>>& d, RayHarmonics<W>& h) {
    using T = F<W>;
    T y[kMaxBands * kMaxBands];
    const Vec<T> to{T{} - d.x, T{} - d.y, T{} - d.z};
    sh_values(k.bands, to, y);
    const int bands = k.bands * k.bands;
    for (int l = 0; l < W; ++l)
        for (int i = 0; i < k.harmonics; ++i) h.y[l][i] = i < bands ? lane(y[i], l) : 0.0f;
    for (int n = 0; n < k.axes; ++n) {
        const LightAxis& axis = k.axis[n];
        if (axis.placed != 0) continue;
        const Vec<T> way{all<T>(axis.at[0]), all<T>(axis.at[1]), all<T>(axis.at[2])};
        set_axis(k, way, to, n, std::uint32_t((std::uint64_t{1} << W) - 1u), h);
    }
}

/// Axes away from a place, for the lanes of `m` at places of their own along the rays `d`.
template <int W>
PILEUS_FN void turn_to_place(const MarchParams& k, const Vec<F<W>>& d, const Vec<F<W>>& place,
                             M<W> m, RayHarmonics<W>& h) {
    using T = F<W>;
    for (int n = 0; n < k.axes; ++n) {
        const LightAxis& axis = k.axis[n];
        if (axis.placed == 0) continue;
        const Vec<T> v{place.x - axis.at[0], place.y - axis.at[1], place.z - axis.at[2]};
        const T inverse = 1.0f / sqrt_(max_(dot(v, v), all<T>(1e-30f)));
        set_axis(k, Vec<T>{v.x * inverse, v.y * inverse, v.z * inverse},
                 Vec<T>{T{} - d.x, T{} - d.y, T{} - d.z}, n, bits_of(m), h);
    }
}

/// part += y times the weighted sum of eight nodes' numbers from `at` on, sixteen side by side.
PILEUS_FN void add_harmonics(const float* const (&from)[8], const float (&weight)[8], int at,
                             const float* y, float (&part)[kHarmonicsAbreast]) {
#if !defined(__CUDACC__)
    using G = F<kHarmonicsAbreast>;
    G sum{}, v;
    for (int j = 0; j < 8; ++j) {
        __builtin_memcpy(&v, from[j] + at, sizeof v);
        sum = sum + all<G>(weight[j]) * v;
    }
    __builtin_memcpy(&v, y, sizeof v);
    G before;
    __builtin_memcpy(&before, part, sizeof before);
    before = before + v * sum;
    __builtin_memcpy(part, &before, sizeof before);
#else
    for (int i = 0; i < kHarmonicsAbreast; ++i) {
        float sum = 0;
        for (int j = 0; j < 8; ++j) sum = sum + weight[j] * from[j][at + i];
        part[i] = part[i] + y[i] * sum;
    }
#endif
}

/// Light of each set that leaves a place along directions with harmonics `y`. Numbers of one node
/// lie side by side and are added up sixteen abreast, in an order that no width changes.
template <class T>
PILEUS_FN void light_along(const MarchParams& k, const float* source, const Corners<T>& c, int l,
                           const float* y, float (&out)[3]) {
    const float fx = lane(c.fx, l), fy = lane(c.fy, l), fz = lane(c.fz, l);
    const std::int32_t xs[2] = {lane(c.x0, l), lane(c.x1, l)};
    const std::int32_t ys[2] = {lane(c.y0, l), lane(c.y1, l)};
    const std::int32_t zs[2] = {lane(c.z0, l), lane(c.z1, l)};
    const float wx[2] = {1.0f - fx, fx}, wy[2] = {1.0f - fy, fy}, wz[2] = {1.0f - fz, fz};
    const int numbers = k.sets * k.harmonics;
    float weight[8];
    const float* from[8];
    for (int j = 0; j < 8; ++j) {
        weight[j] = wx[j & 1] * wy[(j >> 1) & 1] * wz[j >> 2];
        const std::int64_t node = zs[j >> 2] + ys[(j >> 1) & 1] + xs[j & 1];
        from[j] = source + node * numbers;
    }
    for (int s = 0; s < k.sets; ++s) {
        float part[kHarmonicsAbreast] = {};
        for (int i = 0; i < k.harmonics; i += kHarmonicsAbreast)
            add_harmonics(from, weight, s * k.harmonics + i, y + i, part);
        for (int half = kHarmonicsAbreast / 2; half > 0; half /= 2)
            for (int j = 0; j < half; ++j) part[j] = part[j] + part[j + half];
        out[s] = part[0];
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
