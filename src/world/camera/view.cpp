// SPDX-License-Identifier: Apache-2.0
// See view.h.
#include "src/world/camera/view.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "src/base/angles.h"

namespace pileus {
namespace {

/// A vector whose squares would leave the range of doubles, 2^600 times as long.
Double3 in_range(const Double3& a) {
    for (const double v : {a.x, a.y, a.z})
        if (v > 0x1p-300 || v < -0x1p-300) return a;
    return a * 0x1p600;
}
Double3 unit(const Double3& v) {
    const Double3 a = in_range(v);
    return a * (1.0 / glm::length(a));
}
void store(const Double3& from, float (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = float(from[i]);
}
Double3 load(const float (&from)[3]) { return {from[0], from[1], from[2]}; }

}  // namespace

Double3 orbit(const Double3& position_m, const Double3& target_m, double degrees) {
    const SineCosine turn = sincos_deg(degrees);
    const Double3 arm = position_m - target_m;
    return {target_m.x + arm.x * turn.cosine - arm.y * turn.sine,
            target_m.y + arm.x * turn.sine + arm.y * turn.cosine, position_m.z};
}

double ray_slant(const CameraParams& camera, double x, double y) {
    if (camera.orthographic != 0) return 1;
    const double sx = ((x + 0.5) * 2 / whole_width(camera) - 1) * double(camera.half_width) +
                      double(camera.shift_x);
    const double sy = (1 - (y + 0.5) * 2 / whole_height(camera)) * double(camera.half_height) +
                      double(camera.shift_y);
    return __builtin_sqrt(1 + sx * sx + sy * sy);
}

CameraParams make_camera(const Camera& camera, double orbit_deg, const Double3& box_low_m) {
    const Double3 position = orbit(camera.position_m, camera.target_m, orbit_deg);
    const Double3 forward = unit(camera.target_m - position);
    const Double3 right = unit(glm::cross(forward, in_range(camera.up)));
    const Double3 up = glm::cross(right, forward);

    CameraParams out{};
    store(position - box_low_m, out.origin);
    store(forward, out.forward);
    store(right, out.right);
    store(up, out.up);
    out.width = camera.resolution[0];
    out.height = camera.resolution[1];
    const PictureWindow& window = camera.window;
    out.left = window.at[0], out.top = window.at[1];
    out.more_columns = window.more[0], out.more_rows = window.more[1];
    out.parts = window.parts, out.part = window.part;
    out.orthographic = camera.orthographic ? 1 : 0;
    out.flux = camera.flux ? 1 : 0;
    if (camera.has_frustum) {
        out.half_width = float(camera.frustum.half_width);
        out.half_height = float(camera.frustum.half_height);
        out.shift_x = float(camera.frustum.shift_x);
        out.shift_y = float(camera.frustum.shift_y);
        return out;
    }
    const SineCosine half = sincos_deg(camera.fov_deg * 0.5);
    const double height = camera.orthographic ? camera.height_m * 0.5 : half.sine / half.cosine;
    out.half_height = float(height);
    out.half_width = float(height * double(whole_width(out)) / double(whole_height(out)));
    return out;
}

void set_image_camera(const CameraParams& camera, const Double3& box_low_m, Image& image) {
    // Row vectors: [x y z 1] times the matrix, whose rows are columns to GLM. OpenEXR's camera
    // looks along +z, x to the right and y up.
    const glm::dmat3 axes(load(camera.right), load(camera.up), load(camera.forward));
    const Double3 origin = load(camera.origin) + box_low_m;
    glm::dmat4 to_camera(glm::transpose(axes));
    to_camera[3] = glm::dvec4(Double3(0) - origin * axes, 1);

    // Its device coordinates go from 0 to 1, from the left and from the top. In a perspective the
    // fourth one is the distance in front of the camera, by which the others are divided; the third
    // becomes 1 - 1/z, so that the matrix has an inverse.
    glm::dmat4 to_ndc(0);
    const int last = camera.orthographic != 0 ? 3 : 2;
    to_ndc[0][0] = 0.5 / double(camera.half_width);
    to_ndc[1][1] = -0.5 / double(camera.half_height);
    to_ndc[2][2] = to_ndc[last][3] = 1;
    to_ndc[last][0] = 0.5 - 0.5 * double(camera.shift_x) / double(camera.half_width);
    to_ndc[last][1] = 0.5 + 0.5 * double(camera.shift_y) / double(camera.half_height);
    if (camera.orthographic == 0) to_ndc[3][2] = -1;
    const glm::dmat4 both = to_ndc * to_camera;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            const std::size_t at = std::size_t(row * 4 + column);
            image.world_to_camera[at] = float(to_camera[row][column]);
            // Adding 0 leaves no -0.
            image.world_to_ndc[at] = float(both[row][column] + 0.0);
        }
    image.screen_window_width = 2 * camera.half_width;
}

}  // namespace pileus
