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

template <class Share>
ByHeight by_height(const Atmosphere& air, const Share& of) {
    ByHeight out;
    out.horizon = double(air.sky.horizon);
    for (int i = 0; i < kUps; ++i) {
        const double off = double(i) / (kUps - 1);
        const std::array<double, 3> share =
            of(air.tables, air.camera_km, out.horizon + (1 - out.horizon) * (off * off + 1e-9));
        for (std::size_t c = 0; c < 3; ++c) out.share[i][c] = float(share[c]);
    }
    return out;
}

/// Light that comes from everywhere: airglow, the band of faint stars.
void show_wide(int threads, const Atmosphere& air, const SkySeen& on) {
    const ByHeight glow = by_height(air, glow_at), left = by_height(air, wide_left);
    const std::size_t width = std::size_t(on.camera.width);
    const std::size_t pixels = width * std::size_t(on.camera.height);
    const Double3& above = air.sun().above;
    parallel_for(threads, on.camera.height, [&](std::int64_t row, int) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t at = std::size_t(row) * width + x;
            const float part = on.share(at);
            if (!(part > 0)) continue;
            const Ray<float> ray = camera_ray(on.camera, float(x), float(row));
            const double up = double(ray.direction.z);
            float airglow[3], stars[3];
            glow.at(up, airglow);
            left.at(up, stars);
            double band = 0;
            if (air.stars.present())
                band = milky_way(air.stars, {double(ray.direction.x), double(ray.direction.y), up});
            for (std::size_t c = 0; c < 3; ++c)
                on.behind[c * pixels + at] += part * (airglow[c] * float(air.glow[int(c)]) +
                                                      stars[c] * float(band * above[int(c)]));
        }
    });
}

/// The row of this part of the picture that is row `whole` of all of it; -1: another part's.
int own_row(const CameraParams& c, int whole) {
    const int from_top = whole - c.top, band = from_top / kPartRows, in_band = from_top % kPartRows;
    if (from_top < 0 || band % c.parts != c.part) return -1;
    const int own = band / c.parts * kPartRows + in_band;
    return own < c.height ? own : -1;
}

/// Points, each between the four pixels whose middles are around it: their radiances times solid
/// angles add up to its irradiance, whatever the size of pixels.
void show_points(const Atmosphere& air, const SkySeen& on) {
    const CameraParams& c = on.camera;
    if (c.orthographic != 0 || c.dome != 0) return;
    const ByHeight left = by_height(air, sunlight);
    const std::size_t pixels = std::size_t(c.width) * std::size_t(c.height);
    const Double3& above = air.sun().above;
    const Double3 moon = towards_deg(air.moon().azimuth_deg, air.moon().elevation_deg);
    const double hidden = sincos_deg(air.moon_radius_deg).cosine;
    const double wide = 0.5 * whole_width(c) / double(c.half_width),
                 high = 0.5 * whole_height(c) / double(c.half_height);
    for (const Star& star : air.stars.stars.span()) {
        double ahead = 0, right = 0, up = 0, near_moon = 0;
        for (int a = 0; a < 3; ++a) {
            const double to = double(star.to[a]);
            ahead += double(c.forward[a]) * to;
            right += double(c.right[a]) * to;
            up += double(c.up[a]) * to;
            near_moon += moon[a] * to;
        }
        // What is as far aside is in no picture of less than 179 degrees.
        if (!(ahead > 0.01) || double(star.to[2]) < left.horizon) continue;
        if (air.has_moon && near_moon > hidden) continue;
        const double x = right / ahead, y = up / ahead;
        const double column = (x - double(c.shift_x)) * wide + 0.5 * whole_width(c) - 0.5,
                     row = 0.5 * whole_height(c) - (y - double(c.shift_y)) * high - 0.5;
        if (!(column > -1 && column < whole_width(c) && row > -1 && row < whole_height(c)))
            continue;
        const int i0 = int(column + 1) - 1, j0 = int(row + 1) - 1;
        const double slant = 1 + x * x + y * y;
        // Over the solid angle of a pixel.
        const double density = wide * high * slant * __builtin_sqrt(slant);
        float share[3];
        left.at(double(star.to[2]), share);
        for (int j = j0; j <= j0 + 1; ++j)
            for (int i = i0; i <= i0 + 1; ++i) {
                const int own_i = i - c.left, own_j = own_row(c, j);
                if (own_i < 0 || own_i >= c.width || own_j < 0) continue;
                const double across = column - i0, down = row - j0;
                const double weight = (i == i0 ? 1 - across : across) * (j == j0 ? 1 - down : down);
                const std::size_t at =
                    std::size_t(own_j) * std::size_t(c.width) + std::size_t(own_i);
                const double part = weight * density * double(on.share(at));
                for (std::size_t n = 0; n < 3; ++n)
                    on.behind[n * pixels + at] +=
                        float(part * double(star.light[n]) * double(share[n]) * above[int(n)]);
            }
    }
}

}  // namespace

void show_night(int threads, const Atmosphere& air, const SkySeen& on, bool points) {
    if (!(air.glow == Double3{}) || air.stars.present()) show_wide(threads, air, on);
    if (points && air.stars.present()) show_points(air, on);
}

}  // namespace pileus
