// SPDX-License-Identifier: Apache-2.0
// See place.h.
#include "src/clouds/place.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "src/base/vectors.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

Double3 load(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Nearer than this to the plane of the eye, or behind it, nothing is seen.
constexpr double kNearM = 1;

double depth(const CloudView& view, const Double3& at) {
    return view.parallel ? 2 * kNearM : glm::dot(at - view.eye, view.forward);
}

/// The picture goes from -1 to 1 along both axes.
struct Extent {
    double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
    std::size_t before = 0, behind = 0;

    void add(const CloudView& view, const Double3& at) {
        const double z = depth(view, at);
        if (!(z > kNearM)) {
            ++behind;
            return;
        }
        ++before;
        const Double3 to = at - view.eye;
        const double w = view.parallel ? 1 : z;
        const double x = (glm::dot(to, view.right) / w - view.shift_x) / view.half_width;
        const double y = (glm::dot(to, view.up) / w - view.shift_y) / view.half_height;
        low_x = std::min(low_x, x), high_x = std::max(high_x, x);
        low_y = std::min(low_y, y), high_y = std::max(high_y, y);
    }
};

/// Whole pixels from a number that may be far outside.
int pixel(double v, int most) { return int(std::clamp(v, 0.0, double(most))); }

}  // namespace

CloudBox box_of(const CloudPlace& place, const Double3& low_m, const Double3& high_m) {
    CloudBox out;
    const SineCosine yaw = sincos_deg(place.yaw_deg);
    for (std::size_t i = 0; i < 8; ++i) {
        const Double3 p{(i & 1) != 0 ? high_m.x : low_m.x, (i & 2) != 0 ? high_m.y : low_m.y,
                        (i & 4) != 0 ? high_m.z : low_m.z};
        const Double3 turned{p.x * yaw.cosine - p.y * yaw.sine, p.x * yaw.sine + p.y * yaw.cosine,
                             p.z};
        out.corners[i] = turned * place.scale + place.offset_m;
    }
    out.middle = (out.corners[0] + out.corners[7]) * 0.5;
    out.radius = 0.5 * glm::length(out.corners[7] - out.corners[0]);
    return out;
}

CloudView view_of(const Camera& camera) {
    // The floats that the kernels have, so that rays are theirs.
    const CameraParams k = make_camera(camera, 0, camera.position_m);
    CloudView out;
    out.eye = camera.position_m;
    out.right = load(k.right);
    out.up = load(k.up);
    out.forward = load(k.forward);
    out.half_width = double(k.half_width);
    out.half_height = double(k.half_height);
    out.shift_x = double(k.shift_x);
    out.shift_y = double(k.shift_y);
    out.width = k.width;
    out.height = k.height;
    out.parallel = k.orthographic != 0;
    return out;
}

PixelRect covered(const CloudView& view, const Double3* corners, std::size_t count) {
    Extent on;
    for (std::size_t i = 0; i < count; ++i) on.add(view, corners[i]);
    // Where the plane of the eye cuts the box: between any corner before it and any behind.
    if (on.before > 0 && on.behind > 0)
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j) {
                const double from = depth(view, corners[i]), to = depth(view, corners[j]);
                if (from > kNearM && to <= kNearM)
                    on.add(view, corners[i] + (corners[j] - corners[i]) *
                                                  ((from - kNearM) / (from - to) * (1 - 1e-9)));
            }
    if (on.before == 0) return {};
    const double w = view.width, h = view.height;
    PixelRect out;
    out.x0 = pixel((on.low_x * 0.5 + 0.5) * w - 1, view.width);
    out.x1 = pixel((on.high_x * 0.5 + 0.5) * w + 2, view.width);
    out.y0 = pixel((0.5 - on.high_y * 0.5) * h - 1, view.height);
    out.y1 = pixel((0.5 - on.low_y * 0.5) * h + 2, view.height);
    return out;
}

void into_cloud(const CloudPlace& place, Camera& camera) {
    const SineCosine yaw = sincos_deg(place.yaw_deg);
    const Double3 along = turned_back(camera.target_m - camera.position_m, yaw);
    camera.position_m = turned_back(camera.position_m - place.offset_m, yaw) / place.scale;
    camera.target_m = camera.position_m + along;
    camera.up = turned_back(camera.up, yaw);
}

Camera part_camera(const Camera& whole, const CloudView& view, const PixelRect& rect,
                   const CloudPlace& place) {
    Camera out = whole;
    out.resolution = {rect.width(), rect.height()};
    out.has_frustum = true;
    const double w = view.width, h = view.height;
    const double size = view.parallel ? 1 / place.scale : 1;
    out.frustum.half_width = view.half_width * rect.width() / w * size;
    out.frustum.half_height = view.half_height * rect.height() / h * size;
    out.frustum.shift_x =
        (view.shift_x + view.half_width * (double(rect.x0 + rect.x1) / w - 1)) * size;
    out.frustum.shift_y =
        (view.shift_y + view.half_height * (1 - double(rect.y0 + rect.y1) / h)) * size;
    into_cloud(place, out);
    return out;
}

}  // namespace pileus
