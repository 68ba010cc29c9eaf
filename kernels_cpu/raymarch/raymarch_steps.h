// SPDX-License-Identifier: Apache-2.0
// Where the steps of a raymarch lie: even, or growing by a factor from one to the next.
// in: StepParams, how far it is through the medium -> out: metres to step n, and back.
// Palenik 2016, 3.4 and chapter 4; docs/raymarch.md, "Steps".
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/raymarch/raymarch_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// e^x - 1 without cancellation, |x| <= 80.
template <class T>
PILEUS_FN T exp_minus_1(T x) {
    const T small = max_(min_(x, all<T>(0.34f)), all<T>(-0.34f));
    return select(abs_(x) < 0.34f, expm1_core(small), exp_(x) - 1.0f);
}
/// log(1 + x) for x >= 0: the rounding of 1 + x is put right to first order.
template <class T>
PILEUS_FN T log_1_plus(T x) {
    const T u = 1.0f + x;
    return log_(u) + (x - (u - 1.0f)) / u;
}

/// Steps along one ray: step n begins at `first` (q^n - 1)/(q - 1), q = 1 + `excess`.
template <class T>
struct Lattice {
    T first, excess, log_growth;
    bool grows;
};

/// Width of a pixel at a distance.
template <class T>
PILEUS_FN T pixel_width(const CameraParams& camera, const StepParams& k, T distance) {
    return camera.orthographic != 0 ? all<T>(k.pixel) : distance * k.pixel;
}

/// A lattice for a ray that is within the medium for `length` metres, `enter` metres away.
template <class T>
PILEUS_FN Lattice<T> make_lattice(const StepParams& k, T enter, T length) {
    Lattice<T> a{};
    a.grows = k.grows != 0;
    const T least = max_(all<T>(k.least_m), length * 0x1p-24f);
    if (!a.grows) {
        a.first = max_(max_(least, length / k.most), all<T>(1e-30f));
        return a;
    }
    if (k.by_distance != 0) {
        // Steps as long as a pixel is wide there, or longer where `most` would not reach (3.16).
        const T near = max_(enter, all<T>(k.near_m));
        const T needed = exp_minus_1(log_1_plus(length / near) / k.most);
        a.excess = max_(all<T>(k.pixel), needed);
        a.first = near * a.excess;
    } else {
        a.excess = all<T>(k.growth - 1.0f);
        a.first = max_(least, length / k.series);
    }
    a.log_growth = log_1_plus(a.excess);
    return a;
}

/// Metres from the lattice's start to where step n begins.
template <class T>
PILEUS_FN T lattice_place(const Lattice<T>& a, T n) {
    if (!a.grows) return n * a.first;
    return a.first * exp_minus_1(min_(n * a.log_growth, all<T>(80.0f))) / a.excess;
}

/// The step, with its fraction, that lies so many metres from the lattice's start.
template <class T>
PILEUS_FN T lattice_step(const Lattice<T>& a, T metres) {
    if (!a.grows) return metres / a.first;
    return log_1_plus(metres * a.excess / a.first) / a.log_growth;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
