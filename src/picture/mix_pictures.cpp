// SPDX-License-Identifier: Apache-2.0
// See fading.h. A picture that fades, mixed into a new one.
// in: both, their cameras, a share -> out: the new one's planes, changed.
// docs/living.md
#include <cstring>

#include "kernels_cpu/display/upsample_rows.h"
#include "platform/threads.h"
#include "src/picture/fading.h"

namespace pileus {
namespace {

constexpr std::size_t kChunk = 64;   ///< pixels of a row that are mixed at once
constexpr std::size_t kLine = 16;    ///< those whose places in another view lie on a line
constexpr float kOtherThing = 0.1f;  ///< distances further apart are of different things
constexpr float kNowhere = 1e30f;    ///< depths from here on are not known

/// A place in the picture that fades; negative: outside of it.
struct Place {
    float x = -1, y = -1, distance = 0;
};

/// Four pixels around a place, and what each weighs.
struct Corners {
    std::size_t at[4];
    float weight[4];

    Corners(const Place& place, std::int32_t width, std::int32_t height) {
        const int x = int(place.x), y = int(place.y);
        const float fx = place.x - float(x), fy = place.y - float(y);
        const std::size_t right = x + 1 < width ? 1 : 0;
        const std::size_t below = y + 1 < height ? std::size_t(width) : 0;
        at[0] = std::size_t(y) * std::size_t(width) + std::size_t(x);
        at[1] = at[0] + right, at[2] = at[0] + below, at[3] = at[2] + right;
        weight[0] = (1 - fx) * (1 - fy), weight[1] = fx * (1 - fy);
        weight[2] = (1 - fx) * fy, weight[3] = fx * fy;
    }
    float of(const float* plane) const {
        return weight[0] * plane[at[0]] + weight[1] * plane[at[1]] + weight[2] * plane[at[2]] +
               weight[3] * plane[at[3]];
    }
};

std::size_t nearest(const Place& place, std::int32_t width) {
    return std::size_t(int(place.y + 0.5f)) * std::size_t(width) + std::size_t(int(place.x + 0.5f));
}

float towards(float old, float fresh, float share) { return old + share * (fresh - old); }

bool is_other(float a, float b) { return depth_gap<float>(a, b) > kOtherThing; }

/// One launch over rows.
class Mixer {
public:
    Mixer(const FadeInput& in, const FadingPicture& old, Planes& planes)
        : in_(in),
          old_(old),
          planes_(planes),
          pixels_(planes.transmittance.size()),
          before_(old.planes.transmittance.size()) {}

    /// The same view: pixel by pixel.
    void mix_still(std::size_t y, std::size_t x, std::size_t count) const {
        const std::size_t first = y * std::size_t(in_.camera.width) + x;
        float share[kChunk];
        for (std::size_t i = 0; i < count; ++i)
            share[i] = in_.solids && is_other(old_.planes.opaque_depth[first + i],
                                              planes_.opaque_depth[first + i])
                           ? 1.0f
                           : in_.share;
        const auto mix = [&](const Buffer<float>& old, Buffer<float>& to) {
            for (std::size_t at = first; at < to.size(); at += pixels_)
                for (std::size_t i = 0; i < count; ++i)
                    to[at + i] = towards(old[at + i], to[at + i], share[i]);
        };
        const bool clear = is_clear(first, count) &&
                           (std::int32_t(y) < old_.first || std::int32_t(y) >= old_.last ||
                            std::int32_t(x + count) <= old_.left || std::int32_t(x) >= old_.right);
        if (!clear) {
            mix(old_.planes.transmittance, planes_.transmittance);
            mix(old_.planes.colour, planes_.colour);
            mix(old_.planes.cloud, planes_.cloud);
        }
        mix(old_.planes.background, planes_.background);
    }

    /// A row of another view: by where the media, and what is behind them, were seen. Places are
    /// looked up every sixteen pixels and lie on a line between.
    void mix_moved(std::size_t y) const {
        const std::size_t width = std::size_t(in_.camera.width), row = y * width;
        Node begin = node_at(y, 0), end;
        for (std::size_t x = 0; x < width; x += kLine, begin = end) {
            const std::size_t next = x + kLine < width ? x + kLine : width - 1;
            end = node_at(y, next);
            const Line line{row + x, width - x < kLine ? width - x : kLine,
                            next > x ? 1.0f / float(next - x) : 0.0f};
            mix_media(line, begin.ray, end.ray);
            mix_background(line, begin.behind, end.behind);
        }
    }

private:
    /// Nothing of the media shows in the new picture.
    bool is_clear(std::size_t first, std::size_t count) const {
        if (planes_.background.empty()) return false;
        bool clear = true;
        for (std::size_t i = first; i < first + count; ++i)
            clear &= planes_.transmittance[i] == 1.0f && planes_.colour[i] == 0.0f &&
                     planes_.colour[pixels_ + i] == 0.0f && planes_.colour[2 * pixels_ + i] == 0.0f;
        return clear;
    }
    /// Nor did it in the old one between two places.
    bool was_clear(const Place& a, const Place& b) const {
        const float top = float(old_.first - 1), bottom = float(old_.last);
        const float left = float(old_.left - 1), right = float(old_.right);
        return (a.y <= top && b.y <= top) || (a.y >= bottom && b.y >= bottom) ||
               (a.x <= left && b.x <= left) || (a.x >= right && b.x >= right);
    }

    struct Node {
        Ray<float> ray;
        Place behind;  ///< of the ground, where there is one
    };
    struct Line {
        std::size_t first, count;
        float step;  ///< of the way to the other end, each pixel
    };

    Place seen_at(const Ray<float>& ray, float metres) const {
        const SeenBefore<float> seen = seen_before(in_.before, along(ray, metres));
        return seen.seen ? Place{seen.x, seen.y, seen.distance} : Place{};
    }
    Node node_at(std::size_t y, std::size_t x) const {
        const std::size_t at = y * std::size_t(in_.camera.width) + x;
        Node node{camera_ray<float>(in_.camera, float(x), float(y)), Place{}};
        if (!planes_.background.empty() && !planes_.opaque_depth.empty() &&
            !old_.planes.opaque_depth.empty() && planes_.opaque_depth[at] < kNowhere)
            node.behind = seen_at(node.ray, planes_.opaque_depth[at]);
        return node;
    }
    static Place between(const Place& a, const Place& b, const Line& line, std::size_t i) {
        const float t = float(i) * line.step;
        return {towards(a.x, b.x, t), towards(a.y, b.y, t), towards(a.distance, b.distance, t)};
    }

    /// Where the media of a line show: a mean of what is known by the inverses; 0: they hide
    /// little.
    float way_of(const Line& line) const {
        float inverses = 0, known = 0;
        for (std::size_t i = line.first; i < line.first + line.count; ++i)
            if (planes_.half_depth[i] < kNowhere)
                inverses += 1.0f / max_(planes_.half_depth[i], 1e-6f), known += 1.0f;
        return known > 0 ? known / inverses : 0;
    }
    /// Then what shows is spread over the way through the box.
    float middle_of(const Ray<float>& ray) const {
        const Segment<float> box = clip_to_medium(in_.medium, ray);
        return 0.5f * (box.enter + max_(box.leave, box.enter));
    }

    void mix_colour(const Corners& corners, std::size_t at, const Buffer<float>& old,
                    Buffer<float>& to) const {
        const float* from = old.data();
        float* now = to.data() + at;
        for (int c = 0; c < 3; ++c, from += before_, now += pixels_)
            *now = towards(corners.of(from), *now, in_.share);
    }

    void mix_media(const Line& line, const Ray<float>& begin, const Ray<float>& end) const {
        const float way = way_of(line);
        const Place low = seen_at(begin, way > 0 ? way : middle_of(begin));
        const Place high = seen_at(end, way > 0 ? way : middle_of(end));
        if (low.x < 0 || high.x < 0) return;
        if (was_clear(low, high) && is_clear(line.first, line.count)) return;
        for (std::size_t i = 0; i < line.count; ++i) {
            const std::size_t at = line.first + i;
            const Place place = between(low, high, line, i);
            if (in_.solids && is_other(old_.planes.opaque_depth[nearest(place, old_.width)],
                                       planes_.opaque_depth[at]))
                continue;
            const Corners corners(place, old_.width, old_.height);
            planes_.transmittance[at] = towards(corners.of(old_.planes.transmittance.data()),
                                                planes_.transmittance[at], in_.share);
            mix_colour(corners, at, old_.planes.colour, planes_.colour);
            if (!planes_.cloud.empty()) mix_colour(corners, at, old_.planes.cloud, planes_.cloud);
        }
    }

    /// The sky is the new picture's, whose light is the same; the ground has another shadow.
    void mix_background(const Line& line, const Place& low, const Place& high) const {
        if (low.x < 0 || high.x < 0) return;
        // The ground is level between two ends; other things are asked pixel by pixel.
        if (!in_.solids && (was_other(low) || was_other(high))) return;
        for (std::size_t i = 0; i < line.count; ++i) {
            const Place place = between(low, high, line, i);
            if (in_.solids && was_other(place)) continue;
            mix_colour(Corners(place, old_.width, old_.height), line.first + i,
                       old_.planes.background, planes_.background);
        }
    }
    /// Something else stood there.
    bool was_other(const Place& place) const {
        return is_other(old_.planes.opaque_depth[nearest(place, old_.width)], place.distance);
    }

    const FadeInput& in_;
    const FadingPicture& old_;
    Planes& planes_;
    std::size_t pixels_, before_;  ///< of the new picture, and of the old one
};

}  // namespace

bool can_mix(const FadeInput& in, const FadingPicture& old, const Planes& planes) {
    return old.planes.background.empty() == planes.background.empty() &&
           old.planes.cloud.empty() == planes.cloud.empty() &&
           (!in.solids || old.planes.opaque_depth.empty() == planes.opaque_depth.empty());
}

void mix_pictures(const Context& context, const FadeInput& in, const FadingPicture& old,
                  Planes& planes) {
    const bool still = std::memcmp(&in.before, &in.camera, sizeof in.camera) == 0;
    FadeInput own = in;
    own.solids = in.solids && !planes.opaque_depth.empty();
    const Mixer mixer(own, old, planes);
    const std::size_t width = std::size_t(in.camera.width);
    parallel_for(context.threads, in.camera.height, [&](std::int64_t y, int) {
        if (!still) return mixer.mix_moved(std::size_t(y));
        for (std::size_t x = 0; x < width; x += kChunk)
            mixer.mix_still(std::size_t(y), x, width - x < kChunk ? width - x : kChunk);
    });
}

}  // namespace pileus
