// SPDX-License-Identifier: Apache-2.0
// Where a cloud of many stands, and what of a picture it covers.
// in: a cloud's box and its turn, size and place; a camera -> out: corners in the world, pixels.
// docs/clouds.md
#pragma once
#include <array>

#include "src/base/vectors.h"
#include "src/scene/scene.h"

namespace pileus {

/// Turned about the z axis through the kind's origin (counter-clockwise seen from above), made
/// larger, then shifted. The optical thickness stays: a cloud twice as large is half as dense.
struct CloudPlace {
    std::size_t kind = 0;
    Double3 offset_m{};
    double yaw_deg = 0;
    double scale = 1;
    double presence = 1;  ///< factor on its alpha and light: clouds that grow or fade away
};

/// A box of the world, turned about the z axis, and the ball around it.
struct CloudBox {
    std::array<Double3, 8> corners{};
    Double3 middle{};
    double radius = 0;  ///< m
};
CloudBox box_of(const CloudPlace& place, const Double3& low_m, const Double3& high_m);

/// A camera as doubles: the ray of a pixel at (x, y) from the top left is `forward` + right sx +
/// up sy, not of unit length, or parallel to `forward`.
struct CloudView {
    Double3 eye{}, right{}, up{}, forward{};
    double half_width = 1, half_height = 1, shift_x = 0, shift_y = 0;
    int width = 1, height = 1;
    bool parallel = false;

    double sx(double x) const { return (2 * x / width - 1) * half_width + shift_x; }
    double sy(double y) const { return (1 - 2 * y / height) * half_height + shift_y; }
    /// Pixels of a radian in the middle; parallel rays: of a metre.
    double pixels_per_unit() const { return 0.5 * height / half_height; }
};
CloudView view_of(const Camera& camera);

/// Pixels [x0, x1) x [y0, y1).
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    bool empty() const { return x0 >= x1 || y0 >= y1; }
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    std::uint64_t pixels() const {
        return empty() ? 0 : std::uint64_t(width()) * std::uint64_t(height());
    }
};

/// What corners and all between them may cover of the picture, but for what is within a metre of
/// the plane of the eye.
PixelRect covered(const CloudView& view, const Double3* corners, std::size_t count);

/// The camera of a part of the picture, as a cloud at `place` sees it: in its kind's own metres.
Camera part_camera(const Camera& whole, const CloudView& view, const PixelRect& rect,
                   const CloudPlace& place);

/// The camera in a cloud's own metres.
void into_cloud(const CloudPlace& place, Camera& camera);

}  // namespace pileus
