// SPDX-License-Identifier: Apache-2.0
// See view.h.
#include "src/world/camera/view.h"

#include "src/base/angles.h"

namespace pileus {
namespace {

Double3 minus(const Double3& a, const Double3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Double3 cross(const Double3& a, const Double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// A vector whose squares would leave the range of doubles, 2^600 times as long.
Double3 in_range(const Double3& a) {
    for (double v : a)
        if (v > 0x1p-300 || v < -0x1p-300) return a;
    return {a[0] * 0x1p600, a[1] * 0x1p600, a[2] * 0x1p600};
}
Double3 unit(const Double3& v) {
    const Double3 a = in_range(v);
    const double s = 1.0 / __builtin_sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    return {a[0] * s, a[1] * s, a[2] * s};
}
void store(const Double3& from, float (&to)[3]) {
    for (std::size_t i = 0; i < 3; ++i) to[i] = float(from[i]);
}

}  // namespace

Double3 orbit(const Double3& position_m, const Double3& target_m, double degrees) {
    const SineCosine turn = sincos_deg(degrees);
    const Double3 arm = minus(position_m, target_m);
    return {target_m[0] + arm[0] * turn.cosine - arm[1] * turn.sine,
            target_m[1] + arm[0] * turn.sine + arm[1] * turn.cosine, position_m[2]};
}

double ray_slant(const CameraParams& camera, double x, double y) {
    if (camera.orthographic != 0) return 1;
    const double sx = ((x + 0.5) * 2 / camera.width - 1) * double(camera.half_width) +
                      double(camera.shift_x);
    const double sy = (1 - (y + 0.5) * 2 / camera.height) * double(camera.half_height) +
                      double(camera.shift_y);
    return __builtin_sqrt(1 + sx * sx + sy * sy);
}

CameraParams make_camera(const Camera& camera, double orbit_deg, const Double3& box_low_m) {
    const Double3 position = orbit(camera.position_m, camera.target_m, orbit_deg);
    const Double3 forward = unit(minus(camera.target_m, position));
    const Double3 right = unit(cross(forward, in_range(camera.up)));
    const Double3 up = cross(right, forward);

    CameraParams out{};
    store(minus(position, box_low_m), out.origin);
    store(forward, out.forward);
    store(right, out.right);
    store(up, out.up);
    out.width = camera.resolution[0];
    out.height = camera.resolution[1];
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
    out.half_width = float(height * double(out.width) / double(out.height));
    return out;
}

void set_image_camera(const CameraParams& camera, const Double3& box_low_m, Image& image) {
    // Row vectors: [x y z 1] times the matrix. OpenEXR's camera looks along +z, x to the right and
    // y up.
    const float* axes[3] = {camera.right, camera.up, camera.forward};
    double to_camera[4][4] = {};
    to_camera[3][3] = 1;
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row) {
            const double v = double(axes[column][row]);
            to_camera[row][column] = v;
            to_camera[3][column] -= v * (double(camera.origin[row]) + box_low_m[row]);
        }

    // Its device coordinates go from 0 to 1, from the left and from the top. In a perspective the
    // fourth one is the distance in front of the camera, by which the others are divided; the third
    // becomes 1 - 1/z, so that the matrix has an inverse.
    double to_ndc[4][4] = {};
    const std::size_t last = camera.orthographic != 0 ? 3 : 2;
    to_ndc[0][0] = 0.5 / double(camera.half_width);
    to_ndc[1][1] = -0.5 / double(camera.half_height);
    to_ndc[2][2] = to_ndc[last][3] = 1;
    to_ndc[last][0] = 0.5 - 0.5 * double(camera.shift_x) / double(camera.half_width);
    to_ndc[last][1] = 0.5 + 0.5 * double(camera.shift_y) / double(camera.half_height);
    if (camera.orthographic == 0) to_ndc[3][2] = -1;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            double sum = 0;
            for (std::size_t i = 0; i < 4; ++i) sum += to_camera[row][i] * to_ndc[i][column];
            image.world_to_camera[row * 4 + column] = float(to_camera[row][column]);
            image.world_to_ndc[row * 4 + column] = float(sum);
        }
    image.screen_window_width = 2 * camera.half_width;
}

}  // namespace pileus
