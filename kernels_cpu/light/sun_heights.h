// SPDX-License-Identifier: Apache-2.0
// The sun's light by height, in air: what the air above a place leaves of it.
// in: a table of optical depths towards the sun -> out: irradiance on a plane that faces it.
// docs/atmosphere.md, "The sun's colour"
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/light/sun_heights_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// At z, m, box-local: below the first row as on it, above the last as there.
template <class T>
PILEUS_FN T sun_at(const SunHeights& h, T z, int channel) {
    const T place = min_(max_((z - h.low) * h.rows_per_metre, T{}), all<T>(float(h.rows - 1)));
    const auto row = min_(to_int(place), all<I_of<T>>(h.rows - 2));
    const float* const from = h.depth + std::int64_t(channel) * h.rows;
    const T here = gather(from, row), next = gather(from + 1, row);
    return h.above[channel] * exp_(T{} - (here + (next - here) * (place - to_float(row))));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
