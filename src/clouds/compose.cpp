// SPDX-License-Identifier: Apache-2.0
// See compose.h.
#include "src/clouds/compose.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "platform/threads.h"

namespace pileus {
namespace {

/// What comes through less than this is not looked up: less than a step of 8 bits.
constexpr float kHidden = 1.0f / 4096;
/// Rows of a piece of work.
constexpr int kPiece = 8;

/// A row of a source.
class SourceRow {
public:
    SourceRow(const CloudSource& source, const CloudView& view, int y)
        : view_(view), picture_(source.picture) {
        if (source.impostor != nullptr) {
            rows_.emplace(*source.impostor, view);
            rows_->start(y);
        }
        if (picture_ == nullptr) return;
        const PixelRect& rect = picture_->rect;
        if (y < rect.y0 || y >= rect.y1) {
            picture_ = nullptr;
            return;
        }
        y_ = y - rect.y0;
        sy_ = view.sy(y + 0.5);
        row_ = view.forward + view.up * sy_;
    }
    bool sample(int x, float (&out)[5]) const {
        if (rows_) return rows_->sample(x, out);
        if (picture_ == nullptr || x < picture_->rect.x0 || x >= picture_->rect.x1) return false;
        const int column = x - picture_->rect.x0;
        if (picture_->shade.texels == nullptr) return picture_->sample(column, y_, {}, {}, out);
        const double sx = view_.sx(x + 0.5);
        if (view_.parallel)
            return picture_->sample(column, y_, view_.eye + view_.right * sx + view_.up * sy_,
                                    view_.forward, out);
        const double length = __builtin_sqrt(1 + sx * sx + sy_ * sy_);
        return picture_->sample(column, y_, view_.eye, (row_ + view_.right * sx) / length, out);
    }

private:
    const CloudView& view_;
    std::optional<ImpostorRows> rows_;
    const MarchedCloud* picture_;
    int y_ = 0;
    double sy_ = 0;
    Double3 row_{};
};

/// Of both sources by their shares; depths by what each hides.
bool blend(const SourceRow& newer, const SourceRow& older, float share, int x, float (&out)[5]) {
    if (share >= 1) return newer.sample(x, out);
    float a[5] = {}, b[5] = {};
    const bool has_a = newer.sample(x, a), has_b = older.sample(x, b);
    if (!has_a && !has_b) return false;
    const float other = 1.0f - share;
    const float of_a = share * a[3], of_b = other * b[3];
    for (int c = 0; c < 4; ++c) out[c] = share * a[c] + other * b[c];
    out[4] = (of_a * a[4] + of_b * b[4]) / (of_a + of_b);
    return true;
}

/// The place of a pixel on the shadow that lies on a cloud, along a row: linear in depth along the
/// view's axis.
class ShadeRow {
public:
    ShadeRow(const CloudShade& shade, const CloudView& view, double sy) : shade_(shade) {
        if (shade.texels == nullptr) return;
        const Double3 from = (view.eye - shade.middle) / shade.radius;
        const Double3 row = (view.forward + view.up * sy) / shade.radius;
        const Double3 right = view.right / shade.radius;
        const Double3* const axes[2] = {&shade.plane->right, &shade.plane->up};
        for (int a = 0; a < 2; ++a) {
            from_[a] = float(glm::dot(from, *axes[a]));
            row_[a] = float(glm::dot(row, *axes[a]));
            right_[a] = float(glm::dot(right, *axes[a]));
        }
    }
    /// Share of sunlight that is left.
    float left(float sx, float z) const {
        return shadow_at(shade_.texels, kShadeTexels, from_[0] + z * (row_[0] + sx * right_[0]),
                         from_[1] + z * (row_[1] + sx * right_[1]));
    }

private:
    const CloudShade& shade_;
    float from_[2] = {}, row_[2] = {}, right_[2] = {};
};

/// The most frequent way of a near cloud: a perspective picture of this frame alone.
void add_plain_row(const CloudView& view, const MarchedCloud& cloud, int y, Planes& planes) {
    const Planes& from = *cloud.planes;
    const PixelRect& rect = cloud.rect;
    const std::size_t row = std::size_t(y) * std::size_t(view.width);
    const std::size_t pixels = planes.transmittance.size(), part = from.transmittance.size();
    const std::size_t own = std::size_t(y - rect.y0) * std::size_t(rect.width());
    const float* const colour = from.cloud.empty() ? from.colour.data() : from.cloud.data();
    float* const to = planes.colour.data();
    const bool solid = !planes.opaque_depth.empty(), shaded = cloud.shade.texels != nullptr;
    const double sy = view.sy(y + 0.5);
    const ShadeRow shade(cloud.shade, view, sy);
    const float height2 = float(1 + sy * sy);
    for (int x = rect.x0; x < rect.x1; ++x) {
        const std::size_t at = own + std::size_t(x - rect.x0), i = row + std::size_t(x);
        const float alpha = 1.0f - from.transmittance[at];
        const float left = planes.transmittance[i];
        if (!(alpha > 0) || left < kHidden) continue;
        const float depth = cloud.depth(x - rect.x0, y - rect.y0);
        if (solid && !(depth < planes.opaque_depth[i])) continue;
        float v[5];
        for (std::size_t c = 0; c < 3; ++c) {
            v[c] = colour[c * part + at];
            if (!(v[c] > 0)) v[c] = 0;
        }
        v[3] = alpha;
        if (shaded) {
            const float sx = float(view.sx(x + 0.5));
            cloud.shade.darken(shade.left(sx, depth / __builtin_sqrtf(height2 + sx * sx)), v);
        }
        for (std::size_t c = 0; c < 3; ++c) to[c * pixels + i] += left * v[c];
        planes.half_depth[i] += left * alpha * depth;
        planes.transmittance[i] = left * (1.0f - alpha);
    }
}

void add_row(const CloudView& view, const CloudLayer& layer, int y, Planes& planes) {
    const std::size_t pixels = planes.transmittance.size();
    const std::size_t row = std::size_t(y) * std::size_t(view.width);
    const SourceRow newer(layer.newer, view, y), older(layer.older, view, y);
    const bool solid = !planes.opaque_depth.empty();
    for (int x = layer.rect.x0; x < layer.rect.x1; ++x) {
        const std::size_t i = row + std::size_t(x);
        const float left = planes.transmittance[i];
        if (left < kHidden) continue;
        float v[5];
        if (!blend(newer, older, layer.share, x, v)) continue;
        if (solid && !(v[4] < planes.opaque_depth[i])) continue;
        for (std::size_t c = 0; c < 3; ++c) planes.colour[c * pixels + i] += left * v[c];
        planes.half_depth[i] += left * v[3] * v[4];
        planes.transmittance[i] = left * (1.0f - v[3]);
    }
}

}  // namespace

void begin_clouds(int threads, Planes& planes) {
    const std::size_t pixels = planes.transmittance.size();
    parallel_each(threads, pixels, [&](std::size_t i) {
        planes.transmittance[i] = 1;
        planes.half_depth[i] = 0;
        for (std::size_t c = 0; c < 3; ++c) planes.colour[c * pixels + i] = 0;
    });
}

void add_cloud(const CloudView& view, const CloudLayer& layer, int threads, Planes& planes) {
    const PixelRect& rect = layer.rect;
    parallel_for(threads, (rect.height() + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const int begin = rect.y0 + int(piece) * kPiece;
        const bool plain = layer.share >= 1 && layer.newer.picture != nullptr && !view.parallel;
        for (int y = begin; y < std::min(begin + kPiece, rect.y1); ++y)
            plain ? add_plain_row(view, *layer.newer.picture, y, planes)
                  : add_row(view, layer, y, planes);
    });
}

void end_clouds(int threads, Planes& planes) {
    parallel_each(threads, planes.transmittance.size(), [&](std::size_t i) {
        const float hidden = 1.0f - planes.transmittance[i];
        planes.half_depth[i] = hidden > 0 ? planes.half_depth[i] / hidden : __builtin_inff();
    });
}

}  // namespace pileus
