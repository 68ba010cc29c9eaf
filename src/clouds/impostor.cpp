// SPDX-License-Identifier: Apache-2.0
// See impostor.h.
#include "src/clouds/impostor.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "platform/threads.h"

namespace pileus {
namespace {

/// Texels of a side, at the most.
constexpr int kMaxTexels = 2048;
/// Pixels around one that hides little in which another may tell how far the cloud is.
constexpr int kThinPixels = 12;

int texel_count(double tangents, double per_unit) {
    const double n = tangents * per_unit;
    return n > kMaxTexels ? kMaxTexels : n < 1 ? 1 : int(n + 0.999);
}

/// Premultiplied light through the shadow of others, and depths behind the plane.
void fill_texels(const MarchedCloud& picture, const CloudView& view, int threads, Impostor& out) {
    const std::size_t columns = std::size_t(out.width);
    parallel_for(threads, out.height, [&](std::int64_t y, int) {
        for (std::size_t x = 0; x < columns; ++x) {
            const std::size_t i = std::size_t(y) * columns + x;
            float* to = &out.texels[kTexelFloats * i];
            const double sx = view.sx(double(x) + 0.5), sy = view.sy(double(y) + 0.5);
            const double length = __builtin_sqrt(1 + sx * sx + sy * sy);
            const Double3 ray = (view.forward + view.right * sx + view.up * sy) / length;
            float v[5] = {};
            if (picture.sample(int(x), int(y), view.eye, ray, v))
                v[4] = v[3] * float(double(v[4]) - out.plane_m * length);
            for (int c = 0; c < 5; ++c) to[c] = v[c];
        }
    });
}

}  // namespace

float CloudShade::left(const Double3& at) const {
    const Double3 to = at - middle;
    return shadow_at(texels, kShadeTexels, float(glm::dot(to, plane->right) / radius),
                     float(glm::dot(to, plane->up) / radius));
}

float MarchedCloud::depth(int x, int y) const {
    const float* const at = planes->half_depth.data() + y * rect.width() + x;
    if (*at < __builtin_inff()) return *at * scale;
    for (int far = 1; far <= kThinPixels; ++far) {
        const int up = y >= far ? -far * rect.width() : 0, left = x >= far ? -far : 0;
        const int down = y + far < rect.height() ? far * rect.width() : 0;
        const int right = x + far < rect.width() ? far : 0;
        for (const int step : {up, down, left, right})
            if (at[step] < __builtin_inff()) return at[step] * scale;
    }
    return metres;
}

bool MarchedCloud::sample(int x, int y, const Double3& eye, const Double3& ray,
                          float (&out)[5]) const {
    const std::size_t i = std::size_t(y) * std::size_t(rect.width()) + std::size_t(x);
    const float alpha = 1.0f - planes->transmittance[i];
    if (!(alpha > 0)) return false;
    take_light(*planes, i, out);
    out[3] = alpha;
    out[4] = depth(x, y);
    shade.dim_sky(out);
    if (shade.texels != nullptr) shade.darken(shade.left(eye + ray * double(out[4])), out);
    return true;
}

Status capture(const CloudView& view, const CloudPlace& place, const CloudBox& box,
               const CloudShade& shade, double sharpness, CloudGroup& group, Impostor& out) {
    // Until its texels are those of its size.
    out.made = false;
    Camera camera;
    camera.position_m = view.eye;
    camera.target_m = box.middle;
    // The picture's own up, as long as the cloud is not straight along it.
    camera.up = view.up;
    const Double3 to = box.middle - view.eye;
    const double distance = glm::length(to);
    if (glm::length(glm::cross(to, view.up)) < 0.05 * distance) camera.up = view.forward;
    camera.has_frustum = true;
    camera.frustum = {1, 1, 0, 0};
    camera.resolution = {1, 1};
    CloudView own = view_of(camera);
    out.u0 = out.v0 = 1e300;
    out.u1 = out.v1 = -1e300;
    for (const Double3& corner : box.corners) {
        const Double3 d = corner - own.eye;
        const double z = glm::dot(d, own.forward);
        const double u = glm::dot(d, own.right) / z, v = glm::dot(d, own.up) / z;
        out.u0 = std::min(out.u0, u), out.u1 = std::max(out.u1, u);
        out.v0 = std::min(out.v0, v), out.v1 = std::max(out.v1, v);
    }
    out.texels_per_unit = view.pixels_per_unit() * sharpness;
    // A texel of nothing all around.
    out.width = texel_count(out.u1 - out.u0, out.texels_per_unit) + 2;
    out.height = texel_count(out.v1 - out.v0, out.texels_per_unit) + 2;
    const double rim_u = (out.u1 - out.u0) / (out.width - 2);
    const double rim_v = (out.v1 - out.v0) / (out.height - 2);
    out.u0 -= rim_u, out.u1 += rim_u, out.v0 -= rim_v, out.v1 += rim_v;
    camera.frustum = {(out.u1 - out.u0) * 0.5, (out.v1 - out.v0) * 0.5, (out.u0 + out.u1) * 0.5,
                      (out.v0 + out.v1) * 0.5};
    camera.resolution = {out.width, out.height};
    own = view_of(camera);
    out.eye = own.eye, out.right = own.right, out.up = own.up, out.forward = own.forward;
    out.plane_m = glm::dot(to, own.forward);
    for (std::size_t i = 0; i < 4; ++i)
        out.corners[i] = out.eye + (out.forward + out.right * ((i & 1) != 0 ? out.u1 : out.u0) +
                                    out.up * ((i & 2) != 0 ? out.v1 : out.v0)) *
                                       out.plane_m;
    into_cloud(place, camera);
    MarchedCloud picture;
    PILEUS_TRY(group.draw(camera, CloudGroup::Work{}, picture.planes));
    picture.rect = {0, 0, out.width, out.height};
    picture.scale = float(place.scale);
    picture.metres = float(distance);
    picture.shade = shade;
    const std::uint64_t count = std::uint64_t(out.width) * std::uint64_t(out.height);
    if (out.texels.size() != count * kTexelFloats)
        PILEUS_TRY(out.texels.resize(count * kTexelFloats, "picture of a far cloud"));
    fill_texels(picture, own, group.threads(), out);
    out.made = true;
    return Status::ok();
}

void shift(const Double3& by, Impostor& impostor) {
    impostor.eye += by;
    for (Double3& corner : impostor.corners) corner += by;
}

double impostor_error(const Impostor& impostor, const CloudView& view, const CloudBox& box) {
    const Double3 was = box.middle - impostor.eye, is = box.middle - view.eye;
    const double far = glm::length(is);
    const Double3 turn = was / glm::length(was) - is / far;
    // Half of the cloud is before the plane, and so far apart are its parts seen from aside.
    const double moved = glm::length(turn) * box.radius / far * view.pixels_per_unit();
    const double now = view.pixels_per_unit() / far;
    const double then = impostor.texels_per_unit / glm::length(was);
    const double wider = now > then ? now / then - 1 : then / now - 1;
    return std::max(moved, 2 * wider);
}

ImpostorRows::ImpostorRows(const Impostor& impostor, const CloudView& view)
    : impostor_(impostor), view_(view) {
    const Double3 middle = impostor.eye + impostor.forward * impostor.plane_m;
    plane_side_ = glm::dot(middle - view.eye, impostor.forward);
    const Double3 from = view.eye - impostor.eye;
    from_eye_ = {glm::dot(from, impostor.right), glm::dot(from, impostor.up), 0};
    const Double3* const axes[3] = {&impostor.right, &impostor.up, &impostor.forward};
    for (int a = 0; a < 3; ++a)
        step_[a] = glm::dot(view.right, *axes[a]) * 2 * view.half_width / view.width;
    u_scale_ = impostor.width / ((impostor.u1 - impostor.u0) * impostor.plane_m);
    v_scale_ = impostor.height / ((impostor.v1 - impostor.v0) * impostor.plane_m);
}

void ImpostorRows::start(int y) {
    row_y_ = view_.sy(y + 0.5);
    const Double3 ray = view_.forward + view_.right * view_.sx(0.5) + view_.up * row_y_;
    row_[0] = glm::dot(ray, impostor_.right);
    row_[1] = glm::dot(ray, impostor_.up);
    row_[2] = glm::dot(ray, impostor_.forward);
}

bool ImpostorRows::sample(int x, float (&out)[5]) const {
    const Impostor& m = impostor_;
    const double along = row_[2] + step_[2] * x;
    const double t = plane_side_ / along;
    if (!(t > 0)) return false;
    const double u = from_eye_.x + t * (row_[0] + step_[0] * x);
    const double v = from_eye_.y + t * (row_[1] + step_[1] * x);
    const double px = (u - m.u0 * m.plane_m) * u_scale_ - 0.5;
    const double py = (m.v1 * m.plane_m - v) * v_scale_ - 0.5;
    if (!(px >= 0 && py >= 0 && px < m.width - 1 && py < m.height - 1)) return false;
    const int x0 = int(px), y0 = int(py);
    const float fx = float(px - x0), fy = float(py - y0);
    const float* top =
        &m.texels[(std::size_t(y0) * std::size_t(m.width) + std::size_t(x0)) * kTexelFloats];
    const float* low = top + std::size_t(m.width) * kTexelFloats;
    const float w0 = (1.0f - fx) * (1.0f - fy), w1 = fx * (1.0f - fy), w2 = (1.0f - fx) * fy,
                w3 = fx * fy;
    for (std::size_t c = 0; c < 5; ++c)
        out[c] =
            w0 * top[c] + w1 * top[c + kTexelFloats] + w2 * low[c] + w3 * low[c + kTexelFloats];
    if (!(out[3] > 0)) return false;
    const double sx = view_.sx(x + 0.5);
    const float length = float(t * __builtin_sqrt(1 + sx * sx + row_y_ * row_y_));
    const float metres = length + out[4] / out[3];
    out[4] = metres > 0 ? metres : 0.0f;
    return true;
}

}  // namespace pileus
