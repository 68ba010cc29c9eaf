// SPDX-License-Identifier: Apache-2.0
// The layer that a procedural sky fills: flat, or between two spheres around the planet.
// in: world metres, z up from sea level below the origin -> out: altitudes, ways along rays.
// docs/skies.md, "The layer": no difference of squares of radii is ever taken.
#pragma once
#include "kernels_cpu/media/medium.h"
#include "kernels_cpu/procedural/sky_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN Vec<T> sky_world(const SkyParams& k, const Vec<T>& local) {
    return {local.x + k.shift_m[0], local.y + k.shift_m[1], local.z + k.shift_m[2]};
}

/// A place's rise over the tangent plane's sphere: |p - centre|^2 = R^2 + 2 R u.
template <class T>
PILEUS_FN T lifted(const SkyParams& k, const Vec<T>& p) {
    return p.z + 0.5f * k.curvature_per_m * (p.x * p.x + p.y * p.y + p.z * p.z);
}
/// The u of an altitude.
PILEUS_FN float lifted_altitude(const SkyParams& k, float h) {
    return h + 0.5f * k.curvature_per_m * h * h;
}

/// Altitude above the sphere: sqrt(R^2 + 2 R u) - R, written without the difference.
template <class T>
PILEUS_FN T altitude(const SkyParams& k, const Vec<T>& p) {
    if (!(k.curvature_per_m > 0.0f)) return p.z;
    const T u = lifted(k, p);
    const T inside = max_(1.0f + 2.0f * k.curvature_per_m * u, T{});
    return 2.0f * u / (1.0f + sqrt_(inside));
}

/// Roots of |p + t d - centre| = R + h, the nearer first; none: both +infinity.
template <class T>
PILEUS_FN Segment<T> sphere_ways(const SkyParams& k, const Vec<T>& p, const Vec<T>& d, float h) {
    const T far = all<T>(__builtin_inff());
    // t^2 / R + 2 b t + 2 c = 0, all divided by R: b is about the sine of the ray's elevation.
    const T b = d.z + k.curvature_per_m * (p.x * d.x + p.y * d.y + p.z * d.z);
    const T c = lifted(k, p) - lifted_altitude(k, h);
    const T square = b * b - 2.0f * k.curvature_per_m * c;
    const auto meets = square >= 0.0f;
    const T root = sqrt_(max_(square, T{}));
    // The root of larger size first; the other is its partner in the product 2 c R.
    const T q = T{} - (b + copysign_(root, b));
    const T one = q * (1.0f / k.curvature_per_m);
    const T safe = copysign_(max_(abs_(q), all<T>(1e-30f)), q);
    const T two = 2.0f * c / safe;
    return {select(meets, min_(one, two), far), select(meets, max_(one, two), far)};
}

/// The stretch of a ray that can meet the layer; it ends at the planet's surface.
template <class T>
PILEUS_FN Segment<T> clip_to_sky(const SkyParams& k, const Vec<T>& p, const Vec<T>& d) {
    if (!(k.curvature_per_m > 0.0f)) {
        const Segment<T> flat = clip_to_layer(p.z - k.low_m, d.z, k.height_m);
        return {flat.enter, max_(flat.leave, flat.enter)};
    }
    const T here = altitude(k, p), far = all<T>(__builtin_inff());
    const Segment<T> outer = sphere_ways(k, p, d, k.low_m + k.height_m);
    const Segment<T> inner = sphere_ways(k, p, d, k.low_m);
    const Segment<T> ground = sphere_ways(k, p, d, 0.0f);
    const auto within = here < k.low_m;
    const T begin = select(within, inner.leave, max_(outer.enter, T{}));
    const T enter = select(begin < far, max_(begin, T{}), T{});
    T leave = select(outer.leave < far, outer.leave, enter);
    const auto lands = (here >= 0.0f) & (ground.enter > 0.0f);
    leave = select(lands, min_(leave, ground.enter), leave);
    return {enter, max_(leave, enter)};
}

/// Metres along a ray that stay outside the layer, from a place there at altitude `h`.
template <class T>
PILEUS_FN T way_outside(const SkyParams& k, const Vec<T>& p, const Vec<T>& d, T h) {
    const T far = all<T>(1e30f);
    if (!(k.curvature_per_m > 0.0f)) {
        const T goal = select(h < k.low_m, all<T>(k.low_m), all<T>(k.low_m + k.height_m));
        const T safe = copysign_(max_(abs_(d.z), all<T>(1e-18f)), d.z + 0.0f);
        const T t = (goal - h) / safe;
        return select(t >= 0.0f, min_(t, far), far);
    }
    const Segment<T> base = sphere_ways(k, p, d, k.low_m);
    const Segment<T> top = sphere_ways(k, p, d, k.low_m + k.height_m);
    const T t = select(h < k.low_m, base.leave, top.enter);
    return select(t >= 0.0f, min_(t, far), far);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
