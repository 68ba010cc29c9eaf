// SPDX-License-Identifier: Apache-2.0
// Rays through pixel centres, in metres from the low corner of the medium's box.
// in: pixels, of all of a picture or of a window of it -> out: origin and unit direction.
// Plain pinhole or orthographic; the basis is made once on the host (src/world/camera/view.h).
#pragma once
#include "kernels_cpu/core/math.h"
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
    /// Of a window of a larger picture, which is all that `width` and `height` count: its first
    /// pixel there, and by how many pixels that picture is larger. The image plane is that of the
    /// whole.
    std::int32_t left = 0, top = 0, more_columns = 0, more_rows = 0;
    /// Of several parts of a picture, this one: of its rows, eight of each `parts` times eight; 1:
    /// there is one.
    std::int32_t parts = 1, part = 0;
    /// 1: columns are azimuths from north to east, all around, and rows angles from the zenith to
    /// the horizon.
    std::int32_t dome = 0;
};

/// Rows that stay together where a picture is divided.
constexpr std::int32_t kPartRows = 8;

inline namespace PILEUS_ISA {

/// Pixels of the whole picture.
PILEUS_FN std::int32_t whole_width(const CameraParams& c) { return c.width + c.more_columns; }
PILEUS_FN std::int32_t whole_height(const CameraParams& c) { return c.height + c.more_rows; }

/// The whole picture's number of row `y`: a whole number, or several in lanes.
template <class Row>
PILEUS_FN Row picture_row(const CameraParams& c, Row y) {
    if (c.parts == 1) return y + c.top;
    const Row in_band = y & (kPartRows - 1);
    return ((y - in_band) * c.parts + in_band) + (c.part * kPartRows + c.top);
}

template <class T>
struct Ray {
    Vec<T> origin, direction;
};

/// Place on the image plane of pixel (x, y) of the whole picture.
template <class T>
struct PlanePlace {
    T x, y;
};
template <class T>
PILEUS_FN PlanePlace<T> plane_place(const CameraParams& c, T x, T y) {
    return {((x + 0.5f) * (2.0f / float(whole_width(c))) - 1.0f) * c.half_width + c.shift_x,
            (1.0f - (y + 0.5f) * (2.0f / float(whole_height(c)))) * c.half_height + c.shift_y};
}

/// The same of a dome.
template <class T>
PILEUS_FN Ray<T> dome_ray(const CameraParams& c, T x, T y) {
    const SinCos<T> turn = sincos_turns((x + 0.5f) * (1.0f / float(whole_width(c))));
    const SinCos<T> down = sincos_turns((y + 0.5f) * (0.25f / float(whole_height(c))));
    return {{all<T>(c.origin[0]), all<T>(c.origin[1]), all<T>(c.origin[2])},
            {turn.sine * down.sine, turn.cosine * down.sine, down.cosine}};
}

/// Ray through a place in the whole picture, in pixels; y = 0 at the top, whole numbers in their
/// middles.
template <class T>
PILEUS_FN Ray<T> picture_ray(const CameraParams& c, T x, T y) {
    if (c.dome != 0) return dome_ray(c, x, y);
    const PlanePlace<T> place = plane_place(c, x, y);
    const T sx = place.x, sy = place.y;
    const Vec<T> offset{c.right[0] * sx + c.up[0] * sy, c.right[1] * sx + c.up[1] * sy,
                        c.right[2] * sx + c.up[2] * sy};
    const Vec<T> o{all<T>(c.origin[0]), all<T>(c.origin[1]), all<T>(c.origin[2])};
    const Vec<T> f{all<T>(c.forward[0]), all<T>(c.forward[1]), all<T>(c.forward[2])};
    if (c.orthographic) return {{o.x + offset.x, o.y + offset.y, o.z + offset.z}, f};
    return {o, normalized(Vec<T>{f.x + offset.x, f.y + offset.y, f.z + offset.z})};
}

/// Places in the whole picture of pixels (x, y) of the window or part; x and y are whole numbers
/// held in lanes, so that the sums are exact and a window's rays are the whole picture's.
template <class T>
PILEUS_FN T picture_x(const CameraParams& c, T x) {
    return x + float(c.left);
}
template <class T>
PILEUS_FN T picture_y(const CameraParams& c, T y) {
    if (c.parts == 1) return y + float(c.top);
    return to_float(picture_row(c, to_int(y)));
}

/// Ray of pixel (x, y) of the window or part.
template <class T>
PILEUS_FN Ray<T> camera_ray(const CameraParams& c, T x, T y) {
    return picture_ray(c, picture_x(c, x), picture_y(c, y));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
