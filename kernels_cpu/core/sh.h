// SPDX-License-Identifier: Apache-2.0
// Real spherical harmonics y_i, i = l(l+1)+m, up to 8 bands, from Cartesian recurrences.
// in: a unit direction -> out: bands^2 values; m < 0 are the sine terms.
// docs/methods.md 2: orthonormal, no Condon-Shortley sign; |y_lm| <= sqrt((2l+1)/4pi).
#pragma once
#include "kernels_cpu/core/lanes.h"
#include "kernels_cpu/core/vec.h"

namespace pileus {
inline namespace PILEUS_ISA {

constexpr int kMaxBands = 8;

// P(l,m) = a (z P(l-1,m) - b P(l-2,m)), a^2 = (4l^2-1)/(l^2-m^2), b^2 = ((l-1)^2-m^2)/(4(l-1)^2-1).
// clang-format off
PILEUS_NUMBERS float kShA[8][8] = {
    {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {1.73205081f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {1.93649167f, 2.23606798f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {1.97202659f, 2.09165007f, 2.64575131f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {1.98431348f, 2.04939015f, 2.29128785f, 3.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {1.98997487f, 2.0310096f, 2.17124059f, 2.48746859f, 3.31662479f, 0.0f, 0.0f, 0.0f},
    {1.99304346f, 2.02131499f, 2.11394182f, 2.30136835f, 2.67394839f, 3.60555128f, 0.0f, 0.0f},
    {1.99489143f, 2.01556444f, 2.081666f, 2.20794022f, 2.43086217f, 2.85043856f, 3.87298335f, 0.0f},
};
PILEUS_NUMBERS float kShB[8][8] = {
    {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {0.577350269f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {0.516397779f, 0.447213595f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {0.507092553f, 0.478091444f, 0.377964473f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {0.503952631f, 0.487950036f, 0.43643578f, 0.333333333f, 0.0f, 0.0f, 0.0f, 0.0f},
    {0.502518908f, 0.492365964f, 0.460566186f, 0.402015126f, 0.301511345f, 0.0f, 0.0f, 0.0f},
    {0.501745206f, 0.494727445f, 0.473049917f, 0.434524095f, 0.373978796f, 0.277350098f, 0.0f, 0.0f},
};
PILEUS_NUMBERS float kShM[8] = {0.282094792f, 0.488602512f, 0.546274215f, 0.59004359f, 0.625835735f, 0.656382057f, 0.683184105f, 0.707162733f};
// clang-format on

/// Writes bands*bands values to `out`. `Bands` is a constant so that everything unrolls.
template <int Bands, class T>
PILEUS_FN void sh_eval(T x, T y, T z, T* out) {
    T cosine = all<T>(1.0f), sine = T{};  // Re and Im of (x + iy)^m
#pragma GCC unroll 8
    for (int m = 0; m < Bands; ++m) {
        T previous = T{}, current = all<T>(kShM[m]);
#pragma GCC unroll 8
        for (int l = m; l < Bands; ++l) {
            if (l > m) {
                const T next = kShA[l][m] * (z * current - kShB[l][m] * previous);
                previous = current;
                current = next;
            }
            out[l * (l + 1) + m] = current * cosine;
            if (m > 0) out[l * (l + 1) - m] = current * sine;
        }
        const T turned_cosine = cosine * x - sine * y;
        sine = cosine * y + sine * x;
        cosine = turned_cosine;
    }
}

/// The first bands*bands values of y_i(d); evaluates the next even number of bands.
template <class T>
PILEUS_FN void sh_values(int bands, const Vec<T>& d, T* out) {
    if (bands <= 2)
        sh_eval<2>(d.x, d.y, d.z, out);
    else if (bands <= 4)
        sh_eval<4>(d.x, d.y, d.z, out);
    else if (bands <= 6)
        sh_eval<6>(d.x, d.y, d.z, out);
    else
        sh_eval<8>(d.x, d.y, d.z, out);
}

/// Most degrees beyond the bands that are kept about an axis.
constexpr int kMaxAxisDegrees = 16;

/// Legendre polynomials P_l(cosine), l = first ... first + count - 1, count <= kMaxAxisDegrees.
/// Bonnet's recurrence; rounding grows with l and stays below 1e-5 for l < 32.
template <class T>
PILEUS_FN void axis_values(int first, int count, T cosine, T* out) {
    T before = all<T>(1.0f), current = cosine;
    for (int l = 0; l < first + count; ++l) {
        if (l >= first) out[l - first] = before;
        const float next = 1.0f / float(l + 2);
        const T above =
            (float(2 * l + 3) * next) * (cosine * current) - (float(l + 1) * next) * before;
        before = current;
        current = above;
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
