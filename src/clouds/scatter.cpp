// SPDX-License-Identifier: Apache-2.0
// See scatter.h. Dart throwing: a place that is taken is drawn anew.
#include "src/clouds/scatter.h"

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "src/base/angles.h"
#include "src/base/powers.h"
#include "src/base/random_streams.h"

namespace pileus {
namespace {

/// Places that are tried for one cloud.
constexpr std::uint32_t kTries = 256;

/// Numbers of one try of one cloud, uniform in [0, 1).
class Draws {
public:
    Draws(const Key& key, std::uint32_t cloud, std::uint32_t attempt)
        : key_(key), cloud_(cloud), next_(attempt * 4) {}

    double next() {
        if (second_) {
            second_ = false;
            return double(uniform(words_.b));
        }
        words_ = threefry<std::uint32_t>(key_.k0, key_.k1, cloud_, next_++);
        second_ = true;
        return double(uniform(words_.a));
    }
    /// In [low, high].
    double within(const std::array<double, 2>& range) {
        return range[0] + (range[1] - range[0]) * next();
    }
    std::size_t below(std::size_t count) {
        const auto n = std::size_t(next() * double(count));
        return n < count ? n : count - 1;
    }

private:
    Key key_;
    std::uint32_t cloud_, next_;
    Words<std::uint32_t> words_{};
    bool second_ = false;
};

bool apart(const Footprint& a, const Footprint& b) {
    const double x = a.x - b.x, y = a.y - b.y, r = a.radius + b.radius;
    return x * x + y * y > r * r;
}

}  // namespace

Footprint footprint_of(const CloudPlace& place, const KindBox& box) {
    const Double3 middle = (box.low_m + box.high_m) * 0.5, size = box.high_m - box.low_m;
    const SineCosine yaw = sincos_deg(place.yaw_deg);
    Footprint out;
    out.x = place.offset_m.x + place.scale * (middle.x * yaw.cosine - middle.y * yaw.sine);
    out.y = place.offset_m.y + place.scale * (middle.x * yaw.sine + middle.y * yaw.cosine);
    out.radius = 0.5 * place.scale * __builtin_sqrt(size.x * size.x + size.y * size.y);
    return out;
}

Status scatter_clouds(const CloudScatter& scatter, const std::array<double, 2>& center_m,
                      const std::vector<std::size_t>& kinds, const std::vector<KindBox>& boxes,
                      std::vector<CloudPlace>& places) {
    const Key key = make_key(std::uint64_t(scatter.seed), kScatterStream, 0);
    std::vector<Footprint> taken;
    for (const CloudPlace& place : places) taken.push_back(footprint_of(place, boxes[place.kind]));
    const double ratio = scatter.far_m / scatter.near_m;
    for (int i = 0; i < scatter.count; ++i) {
        bool free = false;
        for (std::uint32_t attempt = 0; attempt < kTries && !free; ++attempt) {
            Draws draw(key, std::uint32_t(i), attempt);
            CloudPlace place;
            place.kind = kinds[draw.below(kinds.size())];
            // As many in each ring whose radii have one ratio, so that none is near or far alone.
            const double away = scatter.near_m * power_of(ratio, draw.next());
            const SineCosine towards = sincos_deg(360 * draw.next());
            const double base = draw.within(scatter.base_m);
            place.scale = draw.within(scatter.scale);
            place.yaw_deg =
                double(draw.below(std::size_t(scatter.yaw_steps))) * (360.0 / scatter.yaw_steps);
            const KindBox& box = boxes[place.kind];
            // The middle of its base comes to stand there.
            const Footprint unplaced = footprint_of(place, box);
            place.offset_m = {center_m[0] + away * towards.sine - unplaced.x,
                              center_m[1] + away * towards.cosine - unplaced.y,
                              base - place.scale * box.low_m.z};
            const Footprint own = footprint_of(place, box);
            free = true;
            for (const Footprint& other : taken) free = free && apart(own, other);
            if (!free) continue;
            taken.push_back(own);
            places.push_back(place);
        }
        if (!free && scatter.fewer) return Status::ok();
        if (!free)
            return Status::bad_input("room for " + std::to_string(i) + " of " +
                                     std::to_string(scatter.count) +
                                     " clouds, allowed: fewer, smaller or farther ones");
    }
    return Status::ok();
}

}  // namespace pileus
