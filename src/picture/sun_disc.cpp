// SPDX-License-Identifier: Apache-2.0
// See sun_disc.h.
#include "src/picture/sun_disc.h"

#include <algorithm>
#include <cmath>

#include "src/base/angles.h"

namespace pileus {
namespace {

constexpr int kMaxParts = 64;    // of a pixel's edge
constexpr double kMaxPixel = 8;  // radii of the disc

/// The lit side of a ball as it is seen: along `side`, across the line of sight, and towards us.
struct Terminator {
    bool any = false;
    double side[3] = {}, across = 0, towards = 1;
    double lit = 1;  ///< share of the disc
};
Terminator terminator_of(const SunDisc& disc) {
    Terminator t;
    double square = 0, along = 0;
    for (std::size_t a = 0; a < 3; ++a) square += disc.lit_from[a] * disc.lit_from[a];
    if (!(square > 0)) return t;
    t.any = true;
    for (std::size_t a = 0; a < 3; ++a) along += disc.lit_from[a] * double(disc.to_sun[a]);
    double rest = 0;
    for (int a = 0; a < 3; ++a) {
        t.side[a] = disc.lit_from[std::size_t(a)] - along * double(disc.to_sun[a]);
        rest += t.side[a] * t.side[a];
    }
    t.across = __builtin_sqrt(rest);
    t.towards = -along;
    for (double& v : t.side) v = t.across > 1e-12 ? v / t.across : 0;
    // Of a crescent thinner than this the light goes down with it (moon_position.h).
    t.lit = std::max(0.5 * (1 + t.towards), 0.005);
    return t;
}

/// Whole numbers of pixels that a stretch [low, high] of the picture touches, within [first, end).
struct Stretch {
    int begin, end;
};
Stretch touched(double middle, double reach, int first, int end) {
    const double low = std::min(std::max(middle - reach, first - 1.0), end + 1.0);
    const double high = std::min(std::max(middle + reach, first - 1.0), end + 1.0);
    return {std::max(int(std::floor(low)), first), std::min(int(std::floor(high)) + 1, end)};
}

}  // namespace

void add_sun_disc(const CameraParams& c, const SunDisc& disc, Span<const float> opaque_depth,
                  Span<const float> transmittance, float* behind) {
    double ahead = 0, right = 0, up = 0;
    for (int a = 0; a < 3; ++a) {
        ahead += double(c.forward[a]) * double(disc.to_sun[a]);
        right += double(c.right[a]) * double(disc.to_sun[a]);
        up += double(c.up[a]) * double(disc.to_sun[a]);
    }
    const SineCosine r = sincos_deg(disc.radius_deg);
    // From the side or behind, the disc is in no picture of less than 179 degrees.
    if (c.orthographic != 0 || !(ahead > 0.01)) return;
    const double x = right / ahead, y = up / ahead, slant = 1 + x * x + y * y;
    const double reach = 1.5 * slant * r.sine;  // on the image plane, at distance 1
    const double half_wide = 0.5 * whole_width(c), half_high = 0.5 * whole_height(c);
    const double wide = half_wide / double(c.half_width), high = half_high / double(c.half_height);
    const double middle_x = (x - double(c.shift_x)) * wide + half_wide,
                 middle_y = half_high - (y - double(c.shift_y)) * high;
    // As the whole picture counts pixels.
    const Stretch columns = touched(middle_x, reach * wide + 1, c.left, c.left + c.width);
    const Stretch rows = touched(middle_y, reach * high + 1, 0, whole_height(c));
    const Terminator terminator = terminator_of(disc);
    // Parts of a pixel lie within a sixteenth of the radius, or as many as there may be.
    const double pixel = 1 / std::min(wide, high);
    const double narrow = std::min(4 * terminator.lit, 1.0);
    const int parts = int(std::min(std::max(16 * pixel / r.sine, 4.0) / narrow, double(kMaxParts)));
    // What is smaller than parts are is in one pixel: its area over the pixel's.
    const bool point = pixel > kMaxPixel * r.sine;
    const double own_x = std::floor(middle_x), own_y = std::floor(middle_y);
    double point_share =
        double(disc.to_sun[2]) < disc.horizon
            ? 0
            : kPi64 * r.sine * r.sine * slant * __builtin_sqrt(slant) * wide * high;
    std::array<double, 3> radiance{};
    for (std::size_t n = 0; n < 3; ++n)
        radiance[n] = disc.irradiance[n] / (kPi64 * r.sine * r.sine);
    if (terminator.any) {
        point_share *= terminator.lit;
        for (double& v : radiance) v /= terminator.lit;
    }
    const std::size_t pixels = std::size_t(c.width) * std::size_t(c.height);
    for (int own = 0; own < c.height; ++own) {
        const int j = picture_row(c, own);
        if (j < rows.begin || j >= rows.end) continue;
        for (int i = columns.begin; i < columns.end; ++i) {
            const std::size_t at =
                std::size_t(own) * std::size_t(c.width) + std::size_t(i - c.left);
            if (opaque_depth.size > 0 && opaque_depth.data[at] < 1e30f) continue;
            int within = 0;
            for (int v = 0; v < parts && !point; ++v)
                for (int u = 0; u < parts; ++u) {
                    const double px =
                                     (i + (u + 0.5) / parts - half_wide) / wide + double(c.shift_x),
                                 py =
                                     (half_high - j - (v + 0.5) / parts) / high + double(c.shift_y);
                    double d[3], along = 0, square = 0;
                    for (int a = 0; a < 3; ++a) {
                        d[a] =
                            double(c.forward[a]) + px * double(c.right[a]) + py * double(c.up[a]);
                        along += d[a] * double(disc.to_sun[a]);
                        square += d[a] * d[a];
                    }
                    // |d| sin <= |d| sin r, without a difference of near numbers.
                    double off = 0;
                    for (int a = 0; a < 3; ++a) {
                        const int b = (a + 1) % 3, e = (a + 2) % 3;
                        const double cross =
                            d[b] * double(disc.to_sun[e]) - d[e] * double(disc.to_sun[b]);
                        off += cross * cross;
                    }
                    if (terminator.any) {
                        // Where the line of sight meets the ball: its normal there, of length 1.
                        double side = 0;
                        for (int a = 0; a < 3; ++a) side += d[a] * terminator.side[a];
                        const double length = r.sine * __builtin_sqrt(square);
                        const double rest = std::max(1 - off / (length * length), 0.0);
                        if (side / length * terminator.across +
                                __builtin_sqrt(rest) * terminator.towards <=
                            0)
                            continue;
                    }
                    within +=
                        along > 0 && off <= r.sine * r.sine * square &&
                        d[2] * std::abs(d[2]) >= disc.horizon * std::abs(disc.horizon) * square;
                }
            double share = double(within) / (parts * parts);
            if (point) share = i == own_x && j == own_y ? point_share : 0;
            if (!(share > 0)) continue;
            if (transmittance.size > 0) share *= double(transmittance.data[at]);
            for (std::size_t n = 0; n < 3; ++n)
                behind[n * pixels + at] += float(share * radiance[n]);
        }
    }
}

}  // namespace pileus
