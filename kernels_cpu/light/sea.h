// SPDX-License-Identifier: Apache-2.0
// Light at a rough sea: facets with Gaussian slopes that reflect by Fresnel's equations.
// in: directions -> out: reflected light per irradiance, directions of paths. docs/ground.md
// Cox and Munk 1954; visible facets: Walter et al. 2007; Heitz 2014, "Understanding the
// masking-shadowing function", eq. 17.
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/light/ground_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Of sea water in the middle of the visible.
constexpr float kSeaIndex = 1.34f;

/// Share of unpolarised light that a facet of water reflects; `c`: cosine of the angle to it.
template <class T>
PILEUS_FN T water_reflects(T c) {
    const T g = sqrt_((kSeaIndex * kSeaIndex - 1.0f) + c * c);
    const T away = (g - c) / (g + c);
    const T turn = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
    return 0.5f * away * away * (1.0f + turn * turn);
}

/// A table over [0, `end`], linear.
template <class T>
PILEUS_FN T sea_table(const float (&table)[kSeaCosines + 1], T at, float end) {
    const T p = min_(max_(at * (1.0f / end), T{}), all<T>(1.0f)) * float(kSeaCosines);
    const I_of<T> low = min_(to_int(p), all<I_of<T>>(kSeaCosines - 1));
    const float* const from = table;
    const T a = gather(from, low);
    return a + (gather(from, low + 1) - a) * (p - to_float(low));
}

/// Share of light that a sea reflects in all, seen at an angle to the vertical with this cosine.
template <class T>
PILEUS_FN T sea_reflects(const SeaView& sea, T cosine) {
    return sea_table(sea.reflects, cosine, 1.0f);
}

/// A place on a sea: slopes of the waves that are shown there, and the deviation of all others'.
template <class T>
struct SeaPlace {
    T x, y, slope;
};

/// `metres`: how wide the place is; shorter waves are not shown, and none along the surface, `rise`
/// being the cosine of the view, where waves would hide one another.
template <class T>
PILEUS_FN SeaPlace<T> sea_place(const SeaView& sea, const SeaWaves& waves, const Vec<T>& at,
                                T metres, T rise) {
    SeaPlace<T> out{};
    T square = all<T>(sea.fine * sea.fine);
    const T steep = min_(max_(rise * (0.5f / sea.slope) - 0.5f, T{}), all<T>(1.0f));
    T slow[2];
    for (int i = 0; i < 2; ++i) {
        const T turns = at.x * waves.slow_x[i] + at.y * waves.slow_y[i] + waves.slow_phase[i];
        slow[i] = sincos_turns(turns - to_float(floor_int(turns))).cosine;
    }
    for (int i = 0; i < kSeaWaves; ++i) {
        const T turns = at.x * waves.x[i] + at.y * waves.y[i] +
                        (slow[0] * waves.bend[i][0] + slow[1] * waves.bend[i][1]) + waves.phase[i];
        const T shown = steep * max_(1.0f - metres * (2.0f * waves.per_length[i]), T{});
        const T height = sincos_turns(turns - to_float(floor_int(turns))).cosine * shown;
        out.x = out.x + height * waves.lean_x[i];
        out.y = out.y + height * waves.lean_y[i];
        const float both = waves.lean_x[i] * waves.lean_x[i] + waves.lean_y[i] * waves.lean_y[i];
        square = square + (1.0f - shown * shown) * (0.25f * both);
    }
    out.slope = sqrt_(square);
    return out;
}

/// Facets of a place as they are seen along `from`: in even units of slope what of a facet that
/// leans by x towards the view is seen is max(even + leans x, 0).
template <class T>
struct SeaSight {
    T even, leans;
    T seen;  // mean over all facets
};
template <class T>
PILEUS_FN SeaSight<T> sea_sight(const SeaView& sea, const SeaPlace<T>& place, const Vec<T>& from) {
    SeaSight<T> out;
    // Backs of waves are not seen.
    out.even = max_(from.z - (from.x * place.x + from.y * place.y), T{});
    out.leans = place.slope * sqrt_(max_(from.x * from.x + from.y * from.y, all<T>(1e-12f)));
    const T ratio = out.even / out.leans;
    out.seen = select(ratio < kSeaSeen, out.leans * sea_table(sea.seen, ratio, kSeaSeen), out.even);
    return out;
}

/// Density of what facets reflect into `to`, 1/sr, seen along `from`; both lead upwards from the
/// surface, unless `to` is where a ray goes down first. `cosine`: with the facet.
template <class T>
PILEUS_FN T facet_density(const SeaPlace<T>& place, T seen, const Vec<T>& from, const Vec<T>& to,
                          T& cosine) {
    const Vec<T> sum{from.x + to.x, from.y + to.y, from.z + to.z};
    const T length = sqrt_(dot(sum, sum));
    const auto up = (sum.z > length * 1e-3f) & (length > 0.0f);
    const T down = 1.0f / select(up, sum.z, all<T>(1.0f));
    const T z = select(up, sum.z / max_(length, all<T>(1e-30f)), all<T>(1.0f));
    cosine = select(up, 0.5f * length, all<T>(1.0f));
    const T x = sum.x * down + place.x, y = sum.y * down + place.y;
    const T inverse = 1.0f / (place.slope * place.slope);
    const T p = exp_(-0.5f * (x * x + y * y) * inverse) * (inverse * (2.0f * kInvFourPi));
    return select(up, p / (4.0f * (z * z) * (z * z) * seen), T{});
}

/// Light that a sea reflects along `from` for each unit of irradiance on a plane that faces `to`.
/// A ray that a facet sends down is sent up again as steeply.
/// `density`: of the directions that sea_mirror turns drawn facets to.
template <class T>
PILEUS_FN T sea_glint(const SeaPlace<T>& place, T seen, const Vec<T>& from, const Vec<T>& to,
                      T& density) {
    T c, down;
    const T first = facet_density(place, seen, from, to, c);
    const T second = facet_density(place, seen, from, Vec<T>{to.x, to.y, T{} - to.z}, down);
    density = first + second;
    return first * water_reflects(c) + second * water_reflects(down);
}

/// The facet that leans by `along` towards the view and by `across`, beside the waves: where a ray
/// seen along `from` comes from. `cosine`: with the facet; 0 or less: it is not seen.
template <class T>
PILEUS_FN Vec<T> sea_mirror(const SeaPlace<T>& place, const Vec<T>& from, T along, T across,
                            T& cosine) {
    const T level = sqrt_(max_(from.x * from.x + from.y * from.y, T{}));
    const auto leans = level > 1e-6f;
    const T x = select(leans, from.x / max_(level, all<T>(1e-6f)), all<T>(1.0f));
    const T y = select(leans, from.y / max_(level, all<T>(1e-6f)), T{});
    const T nx = along * x - across * y - place.x, ny = along * y + across * x - place.y;
    const T scale = 1.0f / sqrt_(1.0f + nx * nx + ny * ny);
    const Vec<T> n{nx * scale, ny * scale, scale};
    cosine = dot(from, n);
    const T twice = 2.0f * cosine;
    return {n.x * twice - from.x, n.y * twice - from.y, abs_(n.z * twice - from.z)};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
