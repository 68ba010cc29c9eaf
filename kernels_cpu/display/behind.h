// SPDX-License-Identifier: Apache-2.0
// Light of what lies behind media that turned within the peak of their phase function alone, and
// so goes on as it came.
// in: a direction -> out: radiance.
// docs/ordinates.md, "The march"
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/light/sky_map.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Of what turns within the peak, the share from above the horizon.
template <class T>
PILEUS_FN T share_above(const BehindView& k, T sine) {
    const T at = min_(abs_(sine) * k.per_horizon, all<T>(float(kHorizon - 1)));
    const auto low = to_int(min_(at, all<T>(float(kHorizon - 2))));
    const T first = gather(k.horizon, low), next = gather(k.horizon + 1, low);
    const T share = first + (next - first) * (at - to_float(low));
    return select(sine < 0.0f, 1.0f - share, share);
}

/// Sky and ground along `d`; near the horizon turns come from both sides of it.
template <class T>
PILEUS_FN void light_behind(const BehindView& k, const Vec<T>& d, T (&out)[3]) {
    T sky[3];
    for (int c = 0; c < 3; ++c) sky[c] = all<T>(k.sky[c]);
    if (k.map.columns > 0) {
        // Below the horizon what the map has just above it.
        Vec<T> from = d;
        if (k.has_ground != 0) {
            from.z = max_(d.z, T{});
            const T unit = 1.0f / sqrt_(max_(dot(from, from), all<T>(1e-20f)));
            from = Vec<T>{from.x * unit, from.y * unit, from.z * unit};
        }
        const Vec<T> seen = map_radiance(k.map, from);
        sky[0] = seen.x, sky[1] = seen.y, sky[2] = seen.z;
    }
    const T above = k.has_ground != 0 ? share_above(k, d.z) : all<T>(1.0f);
    for (int c = 0; c < 3; ++c) out[c] = k.ground[c] + (sky[c] - k.ground[c]) * above;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
