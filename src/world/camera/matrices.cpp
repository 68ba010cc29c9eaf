// SPDX-License-Identifier: Apache-2.0
// See matrices.h.
#include "src/world/camera/matrices.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace pileus {
namespace {

constexpr double kInfinity = double(__builtin_inff());
/// How far a host's floats may be from a rotation.
constexpr double kRigid = 1e-4;

bool is_near(double a, double b) { return a - b < kRigid && b - a < kRigid; }

bool is_finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!(m[c][r] - m[c][r] == 0)) return false;
    return true;
}

bool is_rigid(const glm::dmat4& m) {
    const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
    return is_near(glm::dot(x, x), 1) && is_near(glm::dot(y, y), 1) && is_near(glm::dot(z, z), 1) &&
           is_near(glm::dot(x, y), 0) && is_near(glm::dot(y, z), 0) && is_near(glm::dot(z, x), 0) &&
           glm::dot(glm::cross(x, y), z) > 0 && m[0].w == 0 && m[1].w == 0 && m[2].w == 0 &&
           m[3].w == 1;
}

Status bad_projection() {
    return Status::bad_input(
        "projection: neither a perspective nor an orthographic one, allowed: matrices as of "
        "glm::frustum, glm::perspective, glm::ortho");
}

void finish(DepthScale& scale) {
    // Values that grow with the distance end at 1; those of reversed buffers at 0.
    scale.far_value = scale.a * scale.d - scale.b * scale.c >= 0 ? 1 : 0;
    scale.known = true;
}

}  // namespace

double DepthScale::metres(double value) const {
    if (!(value == value)) return 0;
    if (value == far_value) return kInfinity;
    const double clip = lowest + value * (1 - lowest);
    const double below = clip * c - a;
    const double z = below != 0 ? (b - clip * d) / below : kInfinity;
    return z > 0 ? z : 0;
}

double DepthScale::value(double z) const {
    if (!(z < kInfinity)) return far_value;
    const double below = c * z + d;
    if (!(below != 0)) return 1 - far_value;
    const double v = ((a * z + b) / below - lowest) / (1 - lowest);
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

DepthScale depth_scale(bool orthographic, double near_m, double far_m) {
    DepthScale scale;
    const bool ends = far_m > near_m;
    if (orthographic ? !ends : !(near_m > 0)) return scale;
    if (orthographic) {
        scale.a = 1 / (far_m - near_m);
        scale.b = -near_m / (far_m - near_m);
        scale.c = 0;
        scale.d = 1;
    } else {
        scale.a = ends ? far_m / (far_m - near_m) : 1;
        scale.b = ends ? -far_m * near_m / (far_m - near_m) : -near_m;
    }
    finish(scale);
    return scale;
}

Status camera_from_matrices(const glm::dmat4& view, const glm::dmat4& projection, bool zero_to_one,
                            Camera& camera, DepthScale& scale) {
    if (!is_finite(view) || !is_rigid(view))
        return Status::bad_input(
            "view: turns and shifts alone are allowed, no scale, no mirror, columns first");
    // Rows of the turn are the camera's axes in the world.
    const glm::dvec3 right(view[0].x, view[1].x, view[2].x), up(view[0].y, view[1].y, view[2].y),
        back(view[0].z, view[1].z, view[2].z);
    const glm::dvec3 shift(view[3]);
    const glm::dvec3 position = -(right * shift.x + up * shift.y + back * shift.z);

    const glm::dmat4& p = projection;
    const bool perspective = p[2].w == -1 && p[3].w == 0, flat = p[2].w == 0 && p[3].w == 1;
    if (!is_finite(p) || perspective == flat || p[0].w != 0 || p[1].w != 0 || !(p[0].x > 0) ||
        p[1].y == 0 || p[0].y != 0 || p[0].z != 0 || p[1].x != 0 || p[1].z != 0)
        return bad_projection();
    // Vulkan's pictures begin at the other side: the same camera.
    const double flip = p[1].y < 0 ? -1 : 1;
    const glm::dvec4& middle = perspective ? p[2] : p[3];
    const double sign = perspective ? 1 : -1;
    camera.has_frustum = true;
    camera.frustum.half_width = 1 / p[0].x;
    camera.frustum.half_height = 1 / (flip * p[1].y);
    camera.frustum.shift_x = sign * middle.x / p[0].x;
    camera.frustum.shift_y = sign * middle.y / p[1].y;
    camera.orthographic = flat;
    camera.flux = false;
    camera.position_m = position;
    camera.target_m = position - back;
    camera.up = up;

    scale.a = -p[2].z;
    scale.b = p[3].z;
    scale.c = perspective ? 1 : 0;
    scale.d = perspective ? 0 : 1;
    scale.lowest = zero_to_one ? 0 : -1;
    finish(scale);
    return Status::ok();
}

}  // namespace pileus
