// SPDX-License-Identifier: Apache-2.0
// Rays through pixel centres, in metres from the low corner of the medium's box.
// in: pixel coordinates (global, so that tiles do not matter) -> out: origin and unit direction.
// Plain pinhole or orthographic; the basis is made once on the host (src/world/camera/view.h).
#pragma once
#include "kernels_cpu/core/vec.h"

namespace pileus {

/// `half_width`, `half_height`: extent of the image plane at distance 1 (or in metres when
/// orthographic). `right`, `up`, `forward` are orthonormal.
struct CameraParams {
    float origin[3], right[3], up[3], forward[3];
    float half_width, half_height;
    std::int32_t width, height, orthographic;
    std::int32_t flux =
        0;  ///< 1: a flat detector (orthographic too), rays over its front half space
    float shift_x = 0, shift_y = 0;  ///< of the image plane's middle, right and up, as half_width
};

inline namespace PILEUS_ISA {

template <class T>
struct Ray {
    Vec<T> origin, direction;
};

/// Ray of pixel (x, y), y = 0 at the top; x and y are whole numbers held in lanes.
template <class T>
PILEUS_FN Ray<T> camera_ray(const CameraParams& c, T x, T y) {
    const T sx = ((x + 0.5f) * (2.0f / float(c.width)) - 1.0f) * c.half_width + c.shift_x;
    const T sy = (1.0f - (y + 0.5f) * (2.0f / float(c.height))) * c.half_height + c.shift_y;
    const Vec<T> offset{c.right[0] * sx + c.up[0] * sy, c.right[1] * sx + c.up[1] * sy,
                        c.right[2] * sx + c.up[2] * sy};
    const Vec<T> o{all<T>(c.origin[0]), all<T>(c.origin[1]), all<T>(c.origin[2])};
    const Vec<T> f{all<T>(c.forward[0]), all<T>(c.forward[1]), all<T>(c.forward[2])};
    if (c.orthographic) return {{o.x + offset.x, o.y + offset.y, o.z + offset.z}, f};
    return {o, normalized(Vec<T>{f.x + offset.x, f.y + offset.y, f.z + offset.z})};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
