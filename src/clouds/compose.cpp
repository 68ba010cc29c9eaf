// SPDX-License-Identifier: Apache-2.0
// See compose.h.
#include "src/clouds/compose.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "platform/threads.h"

namespace pileus {
namespace {

/// What comes through less than this is not looked up: less than a step of 8 bits.
constexpr float kHidden = 1.0f / 4096;
/// Rows of a piece of work, and pixels of a row that are sorted together.
constexpr int kPiece = 8, kBlock = 64;

/// A row of a source.
class SourceRow {
public:
    SourceRow(const CloudSource& source, const CloudView& view, int y)
        : view_(view), gain_(source.gain), picture_(source.picture) {
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
        if (!look_up(x, out)) return false;
        for (std::size_t c = 0; c < 3; ++c) out[c] *= gain_[c];
        return true;
    }

private:
    bool look_up(int x, float (&out)[5]) const {
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

    const CloudView& view_;
    std::array<float, 3> gain_;
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

/// Premultiplied R G B, alpha, metres along the ray.
struct Fragment {
    float v[5];
};

/// Pixels of a block of a row: what is final, and what may still come before something else.
struct Block {
    int x0 = 0, count = 0;
    std::size_t first = 0;  ///< number of its first pixel
    std::array<Fragment, std::size_t(kBlock) * kCloudsInPixel> held{};
    std::array<std::uint8_t, kBlock> number{};  ///< of those that are held, the nearest first
    std::array<float, kBlock> left{};           ///< transmittance of what is final
};

class BlockPlanes {
public:
    BlockPlanes(Block& block, Planes& planes)
        : block_(block),
          planes_(planes),
          pixels_(planes.transmittance.size()),
          solid_(!planes.opaque_depth.empty()) {}

    /// Makes final what is nearer than `near_m`, of one pixel. False: the rest is hidden.
    bool open(int i, float near_m) {
        Fragment* const list = list_of(i);
        int count = block_.number[std::size_t(i)], done = 0;
        while (done < count && list[done].v[4] <= near_m) finish(i, list[done++]);
        if (done > 0) {
            std::copy(list + done, list + count, list);
            count -= done;
        }
        block_.number[std::size_t(i)] = std::uint8_t(count);
        return !(block_.left[std::size_t(i)] < kHidden);
    }
    /// Takes a fragment up in its place.
    void add(int i, const float (&v)[5]) {
        if (solid_ && !(v[4] < planes_.opaque_depth[block_.first + std::size_t(i)])) return;
        const Fragment f{{v[0], v[1], v[2], v[3], v[4]}};
        Fragment* const list = list_of(i);
        int count = block_.number[std::size_t(i)];
        if (count == kCloudsInPixel) {
            // No room: the nearest one is final, which may be this.
            if (v[4] < list[0].v[4]) return finish(i, f);
            finish(i, list[0]);
            std::copy(list + 1, list + count, list);
            --count;
        }
        int at = count;
        for (; at > 0 && v[4] < list[at - 1].v[4]; --at) list[at] = list[at - 1];
        list[at] = f;
        block_.number[std::size_t(i)] = std::uint8_t(++count);
    }
    /// All that is held becomes final, and sums of depths means.
    void close() {
        for (int i = 0; i < block_.count; ++i) {
            (void)open(i, __builtin_inff());
            const std::size_t at = block_.first + std::size_t(i);
            const float hidden = 1.0f - block_.left[std::size_t(i)];
            planes_.transmittance[at] = block_.left[std::size_t(i)];
            planes_.half_depth[at] =
                hidden > 0 ? planes_.half_depth[at] / hidden : __builtin_inff();
        }
    }
    void begin(int x0, int count, std::size_t first) {
        block_.x0 = x0, block_.count = count, block_.first = first;
        for (int i = 0; i < count; ++i) {
            const std::size_t at = first + std::size_t(i);
            block_.number[std::size_t(i)] = 0;
            block_.left[std::size_t(i)] = 1;
            planes_.half_depth[at] = 0;
            for (std::size_t c = 0; c < 3; ++c) planes_.colour[c * pixels_ + at] = 0;
        }
    }

private:
    Fragment* list_of(int i) { return &block_.held[std::size_t(i) * kCloudsInPixel]; }
    void finish(int i, const Fragment& f) {
        float& left = block_.left[std::size_t(i)];
        if (left < kHidden) return;
        const std::size_t at = block_.first + std::size_t(i);
        for (std::size_t c = 0; c < 3; ++c) planes_.colour[c * pixels_ + at] += left * f.v[c];
        planes_.half_depth[at] += left * f.v[3] * f.v[4];
        left *= 1.0f - f.v[3];
    }

    Block& block_;
    Planes& planes_;
    std::size_t pixels_;
    bool solid_;
};

/// Rows of what is shown, as far as they lie in one row of the picture.
class ShownRow {
public:
    ShownRow(const CloudView& view, const ShownCloud& shown, int y)
        : view_(view),
          shown_(shown),
          y_(y),
          sy_(view.sy(y + 0.5)),
          plain_(shown.layer == nullptr && shown.share >= 1 && shown.newer.picture != nullptr &&
                 !view.parallel) {
        if (plain_) shade_.emplace(shown.newer.picture->shade, view, sy_);
        if (plain_ || shown.layer != nullptr) return;
        newer_.emplace(shown.newer, view, y);
        older_.emplace(shown.older, view, y);
    }
    void add(BlockPlanes& to, const Block& block) const {
        const int begin = std::max(block.x0, shown_.rect.x0);
        const int end = std::min(block.x0 + block.count, shown_.rect.x1);
        for (int x = begin; x < end; ++x) {
            const int i = x - block.x0;
            if (!to.open(i, shown_.near_m)) continue;
            float v[5];
            if (!sample(x, v)) continue;
            if (shown_.presence < 1)
                for (int c = 0; c < 4; ++c) v[c] *= shown_.presence;
            to.add(i, v);
        }
    }

private:
    bool sample(int x, float (&v)[5]) const {
        if (shown_.layer != nullptr) return sample_layer(x, v);
        if (plain_) return sample_plain(x, v);
        return blend(*newer_, *older_, shown_.share, x, v);
    }
    /// The most frequent way of a near cloud: a perspective picture of this frame alone.
    bool sample_plain(int x, float (&v)[5]) const {
        const MarchedCloud& cloud = *shown_.newer.picture;
        const Planes& from = *cloud.planes;
        const PixelRect& rect = cloud.rect;
        const std::size_t at =
            std::size_t(y_ - rect.y0) * std::size_t(rect.width()) + std::size_t(x - rect.x0);
        v[3] = 1.0f - from.transmittance[at];
        if (!(v[3] > 0)) return false;
        take_light(from, at, v);
        v[4] = cloud.depth(x - rect.x0, y_ - rect.y0);
        cloud.shade.dim_sky(v);
        if (cloud.shade.texels != nullptr) {
            const float sx = float(view_.sx(x + 0.5));
            const float height2 = float(1 + sy_ * sy_);
            cloud.shade.darken(shade_->left(sx, v[4] / __builtin_sqrtf(height2 + sx * sx)), v);
        }
        for (std::size_t c = 0; c < 3; ++c) v[c] *= shown_.newer.gain[c];
        return true;
    }
    bool sample_layer(int x, float (&v)[5]) const {
        const LayerPicture& layer = *shown_.layer;
        const Planes& from = *layer.planes;
        const std::size_t at = std::size_t(y_) * std::size_t(view_.width) + std::size_t(x);
        v[3] = 1.0f - from.transmittance[at];
        if (!(v[3] > 0)) return false;
        take_light(from, at, v);
        v[4] = from.half_depth[at];
        // Where nothing shades it, or there is no sun.
        for (std::size_t c = 0; c < 3 && layer.sources == nullptr; ++c) v[c] *= layer.sky_left;
        if (v[4] < __builtin_inff() && layer.sources == nullptr) return true;
        const double sx = view_.sx(x + 0.5);
        const double length = __builtin_sqrt(1 + sx * sx + sy_ * sy_);
        const Double3 ray = view_.parallel
                                ? view_.forward
                                : (view_.forward + view_.up * sy_ + view_.right * sx) / length;
        const Double3 eye =
            view_.parallel ? view_.eye + view_.up * sy_ + view_.right * sx : view_.eye;
        if (!(v[4] < __builtin_inff())) v[4] = float(layer.layer->way_to_middle(eye, ray));
        // Its march has ended where something stands.
        if (!from.opaque_depth.empty()) v[4] = std::min(v[4], 0.999f * from.opaque_depth[at]);
        if (layer.sources == nullptr) return true;
        const float left =
            sunlight_left(*layer.plane, *layer.sources, eye + ray * double(v[4]), true);
        for (std::size_t c = 0; c < 3; ++c)
            v[c] *= layer.sun_share[c] * left + (1.0f - layer.sun_share[c]) * layer.sky_left;
        return true;
    }

    const CloudView& view_;
    const ShownCloud& shown_;
    int y_;
    double sy_;
    bool plain_;
    std::optional<ShadeRow> shade_;
    std::optional<SourceRow> newer_, older_;
};

}  // namespace

void compose_clouds(const CloudView& view, const std::vector<ShownCloud>& shown, int threads,
                    Planes& planes) {
    parallel_for(threads, (view.height + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const auto block = std::make_unique<Block>();
        BlockPlanes to(*block, planes);
        const int begin = int(piece) * kPiece;
        for (int y = begin; y < std::min(begin + kPiece, view.height); ++y) {
            std::vector<ShownRow> rows;
            rows.reserve(shown.size());
            for (const ShownCloud& s : shown)
                if (y >= s.rect.y0 && y < s.rect.y1) rows.emplace_back(view, s, y);
            const std::size_t row = std::size_t(y) * std::size_t(view.width);
            for (int x = 0; x < view.width; x += kBlock) {
                to.begin(x, std::min(kBlock, view.width - x), row + std::size_t(x));
                for (const ShownRow& r : rows) r.add(to, *block);
                to.close();
            }
        }
    });
}

}  // namespace pileus
