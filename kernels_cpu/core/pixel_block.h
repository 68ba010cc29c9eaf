// SPDX-License-Identifier: Apache-2.0
// Pixels side by side in lanes: small blocks of the picture, whose rays stay together.
// in: a place in the picture -> out: the lanes of a block and the pixels they stand for.
// docs/architecture.md, "Kernels: written once".
#pragma once
#include "kernels_cpu/core/camera.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Lanes hold a block of pixels, so many of each row: its rays stay together longer than a row's.
template <int W>
constexpr int kMarchAcross = W >= 8   ? 4
                             : W >= 4 ? 2
                                      : 1;

/// Calls function(lane, pixel) for the lanes of a block from (x, y) on that lie in the picture,
/// which has a width and a height, above row `end`.
template <int W, class Picture, class Function>
PILEUS_FN void for_block(const Picture& c, std::int32_t x, std::int32_t y, std::int32_t end,
                         Function function) {
    constexpr int across = kMarchAcross<W>;
    for (int l = 0; l < W; ++l)
        if (x + l % across < c.width && y + l / across < end)
            function(l, std::int64_t(y + l / across) * c.width + x + l % across);
}

/// The first `real` lanes from or to places side by side; other lanes are 0.
template <class T>
PILEUS_FN T take_lanes(const float* from, std::int32_t real) {
    T v{};
    if (real >= width_of<T>)
        __builtin_memcpy(&v, from, sizeof v);
    else
        for (int l = 0; l < real; ++l) set_lane(v, l, from[l]);
    return v;
}
template <class T>
PILEUS_FN void put_lanes(const T& v, float* to, std::int32_t real) {
    if (real >= width_of<T>)
        __builtin_memcpy(to, &v, sizeof v);
    else
        for (int l = 0; l < real; ++l) to[l] = lane(v, l);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
