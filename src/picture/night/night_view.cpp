// SPDX-License-Identifier: Apache-2.0
// See night_view.h.
#include "src/picture/night/night_view.h"

#include "platform/threads.h"
#include "src/world/atmosphere/night_light.h"

namespace pileus {
namespace {

/// Shares by the cosine to the vertical, close around the horizon.
constexpr int kUps = 257;
struct ByHeight {
    double horizon = -1;
    float share[kUps][3];

    void at(double cosine, float (&out)[3]) const {
        for (float& v : out) v = 0;
        if (!(cosine >= horizon)) return;
        const double place = __builtin_sqrt((cosine - horizon) / (1 - horizon)) * (kUps - 1);
        const int low = place < kUps - 2 ? int(place) : kUps - 2;
        const float part = float(place - low);
        for (int c = 0; c < 3; ++c)
            out[c] = share[low][c] + (share[low + 1][c] - share[low][c]) * part;
    }
};

ByHeight glow_by_height(const Atmosphere& air) {
    ByHeight out;
    out.horizon = double(air.sky.horizon);
    for (int i = 0; i < kUps; ++i) {
        const double off = double(i) / (kUps - 1);
        const std::array<double, 3> share = glow_at(
            air.tables, air.camera_km, out.horizon + (1 - out.horizon) * (off * off + 1e-9));
        for (std::size_t c = 0; c < 3; ++c) out.share[i][c] = float(share[c]);
    }
    return out;
}

}  // namespace

void show_night(int threads, const Atmosphere& air, const SkySeen& on) {
    if (air.glow == Double3{}) return;
    const ByHeight glow = glow_by_height(air);
    const std::size_t width = std::size_t(on.camera.width);
    const std::size_t pixels = width * std::size_t(on.camera.height);
    parallel_for(threads, on.camera.height, [&](std::int64_t row, int) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t at = std::size_t(row) * width + x;
            const float part = on.share(at);
            if (!(part > 0)) continue;
            const Ray<float> ray = camera_ray(on.camera, float(x), float(row));
            float share[3];
            glow.at(double(ray.direction.z), share);
            for (std::size_t c = 0; c < 3; ++c)
                on.behind[c * pixels + at] += part * share[c] * float(air.glow[int(c)]);
        }
    });
}

}  // namespace pileus
