// SPDX-License-Identifier: Apache-2.0
// Directions over a plane with the density of a Lambertian surface: cosine over pi.
// in: 64 random bits -> out: height over the plane and the two components in it.
// docs/path.md, "Ground and flux camera"
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Cosine-weighted direction: height over the plane and the two components in it.
template <class T>
struct Lambert {
    T normal, a, b;
};
template <class UU>
PILEUS_FN auto lambert(Words<UU> w) {
    using T = F_of<UU>;
    const T u = uniform(w.a);
    const SinCos<T> turn = sincos_turns(uniform(w.b));
    const T sine = sqrt_(u);
    return Lambert<T>{sqrt_(1.0f - u), sine * turn.cosine, sine * turn.sine};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
