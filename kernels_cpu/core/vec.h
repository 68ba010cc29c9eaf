// SPDX-License-Identifier: Apache-2.0
// Three lanes as a vector, and the frame around a direction.
// in: lanes -> out: lanes; no trigonometry.
// Frame: Duff et al. 2017, "Building an orthonormal basis, revisited" (branch-free by copysign).
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
struct Vec {
    T x, y, z;
};

template <class T>
PILEUS_FN T dot(const Vec<T>& a, const Vec<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
PILEUS_FN Vec<T> normalized(const Vec<T>& v) {
    const T inverse = 1.0f / sqrt_(dot(v, v));
    return {v.x * inverse, v.y * inverse, v.z * inverse};
}

/// The unit vector at angle theta from `axis`, azimuth phi; renormalised, so that a million
/// successive turns stay within a few ulp of unit length (docs/testing.md S11).
template <class T>
PILEUS_FN Vec<T> turned(const Vec<T>& axis, T cosine, T sine, T cos_phi, T sin_phi) {
    const T one = all<T>(1.0f);
    const T s = copysign_(one, axis.z);
    const T a = -1.0f / (s + axis.z);
    const T b = axis.x * axis.y * a;
    const Vec<T> t{one + s * axis.x * axis.x * a, s * b, T{} - s * axis.x};
    const Vec<T> n{b, s + axis.y * axis.y * a, T{} - axis.y};
    const T u = sine * cos_phi, v = sine * sin_phi;
    return normalized(Vec<T>{t.x * u + n.x * v + axis.x * cosine,
                             t.y * u + n.y * v + axis.y * cosine,
                             t.z * u + n.z * v + axis.z * cosine});
}

/// 1 - cos of the angle between unit vectors, exact for small angles: |a - b|^2 / 2.
template <class T>
PILEUS_FN T one_minus_cosine(const Vec<T>& a, const Vec<T>& b) {
    const Vec<T> d{a.x - b.x, a.y - b.y, a.z - b.z};
    return 0.5f * dot(d, d);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
