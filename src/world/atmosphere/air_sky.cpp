// SPDX-License-Identifier: Apache-2.0
// See air_sky.h.
#include "src/world/atmosphere/air_sky.h"

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/world/atmosphere/air_column.h"

namespace pileus {
namespace {

constexpr int kViewSteps = 32;

double held(double v, double low, double high) { return v < low ? low : v > high ? high : v; }
double root(double v) { return v > 0 ? __builtin_sqrt(v) : 0; }

double horizon_at(double height_km) {
    const double r = kEarthRadiusKm / (kEarthRadiusKm + height_km);
    return -root(1 - r * r);
}

}  // namespace

AirLight air_light(const AirTables& t, double height_km, double cosine, double sun, double along,
                   double most_km, int steps) {
    AirLight out{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}};
    const double r = kEarthRadiusKm + (height_km > 1e-4 ? height_km : 1e-4);
    double first = 0;
    if (r > kAirTopKm) {
        first = way_to_sphere(r, cosine, kAirTopKm, false);
        if (first < 0) return out;
    }
    const double ground = way_to_sphere(r, cosine, kEarthRadiusKm, false);
    const bool hits = ground >= 0 && ground <= most_km;
    double last = hits ? ground : way_to_sphere(r, cosine, kAirTopKm, true);
    if (last > most_km) last = most_km;
    if (!(last > first)) return out;
    const float phase = air_phase(float(along));
    float y[kAirTerms];
    const double sides = root((1 - cosine * cosine) * (1 - sun * sun));
    air_harmonics(cosine, sides > 1e-9 ? held((along - cosine * sun) / sides, -1, 1) : 1, y);
    AirWalk walk(r, cosine, first);
    double before = first;
    for (int i = 0; i < steps; ++i) {
        const double end = first + (last - first) * step_end((i + 1.0) / steps, hits || first > 0);
        const double s = 0.5 * (before + end);
        before = end;
        const double at = __builtin_sqrt(r * r + s * s + 2 * r * s * cosine);
        const double mu = (r * sun + s * along) / at;
        const float height = float(at - kEarthRadiusKm);
        const AirPiece piece = piece_of(t.air, walk.to(end));
        float sunlight[3], by_air[3], by_haze[3];
        sunlight_at(t, at, mu, sunlight);
        scattered_at(t, height, float(mu), y, by_air, by_haze);
        for (int c = 0; c < 3; ++c) {
            out.smooth[c] += out.left[c] * (piece.by_air[c] * (phase * sunlight[c] + by_air[c]) +
                                            piece.by_haze[c] * by_haze[c]);
            out.haze[c] += out.left[c] * piece.by_haze[c] * sunlight[c];
            out.left[c] *= piece.left[c];
        }
    }
    if (!hits) return out;
    const double mu = (r * sun + last * along) / kEarthRadiusKm;
    float sunlight[3], sky[3];
    sunlight_at(t, kEarthRadiusKm, mu, sunlight);
    ground_light(t, float(mu), sky);
    for (int c = 0; c < 3; ++c)
        out.smooth[c] +=
            out.left[c] * t.air.ground / kPi * (float(mu > 0 ? mu : 0) * sunlight[c] + sky[c]);
    return out;
}

Status make_air_sky(const AirTables& tables, double height_km, double sun_cosine, int threads,
                    AirSky& view) {
    constexpr int kRows = kSkyDowns + kSkyUps;
    view.height_km = height_km > 0 ? height_km : 0;
    view.sun = float(sun_cosine);
    view.horizon = float(horizon_at(view.height_km));
    view.haze_g = tables.air.haze_g;
    PILEUS_TRY(view.texels.resize(std::size_t{8} * kRows * kSkyTurns, "sky view"));
    const double horizon = double(view.horizon), sun_side = root(1 - sun_cosine * sun_cosine);
    parallel_for(threads, kRows, [&](std::int64_t row, int) {
        const bool up = row >= kSkyDowns;
        const double x =
            up ? double(row - kSkyDowns) / (kSkyUps - 1) : 1 - double(row) / (kSkyDowns - 1);
        // A hair beside the horizon: rays along it are neither.
        const double off = x > 1e-3 ? x : 1e-3;
        const double cosine =
            up ? horizon + (1 - horizon) * off * off : horizon - (1 + horizon) * off * off;
        const double side = root(1 - cosine * cosine);
        float* out = view.texels.data() + std::size_t(row) * 8 * kSkyTurns;
        for (int i = 0; i < kSkyTurns; ++i, out += 8) {
            // Column: the sine of half the azimuth from the sun.
            const double half = double(i) / (kSkyTurns - 1);
            const double east = 1 - 2 * half * half;
            const AirLight light =
                air_light(tables, view.height_km, cosine, sun_cosine,
                          cosine * sun_cosine + side * sun_side * east, 1e9, kViewSteps);
            for (int c = 0; c < 3; ++c) out[c] = light.smooth[c], out[3 + c] = light.haze[c];
        }
    });
    return Status::ok();
}

void sky_radiance(const AirSky& view, double cosine, double along, float (&radiance)[3]) {
    const double horizon = double(view.horizon), sun = double(view.sun);
    const bool up = cosine >= horizon;
    const double off =
        up ? root((cosine - horizon) / (1 - horizon)) : root((horizon - cosine) / (1 + horizon));
    const double x = off < 1 ? off : 1;
    const double y = up ? kSkyDowns + x * (kSkyUps - 1) : (1 - x) * (kSkyDowns - 1);
    const double first = up ? kSkyDowns : 0, rows = up ? kSkyUps : kSkyDowns;
    const double sides = root((1 - cosine * cosine) * (1 - sun * sun));
    const double east = sides > 1e-9 ? (along - cosine * sun) / sides : 1;
    const double half = root(held(0.5 - 0.5 * east, 0, 1)) * (kSkyTurns - 1);
    const double y0 = double(int(held(y, first, first + rows - 2)));
    const double x0 = double(int(held(half, 0, kSkyTurns - 2)));
    const float fy = float(y - y0), fx = float(half - x0);
    const float* a = view.texels.data() + 8 * (std::size_t(y0) * kSkyTurns + std::size_t(x0));
    const float* b = a + 8 * kSkyTurns;
    const float phase = haze_phase(view.haze_g, float(along));
    for (int c = 0; c < 3; ++c) {
        const auto mixed = [&](int i) {
            const float top = a[i] + (a[8 + i] - a[i]) * fx, low = b[i] + (b[8 + i] - b[i]) * fx;
            return top + (low - top) * fy;
        };
        radiance[c] = mixed(c) + phase * mixed(3 + c);
    }
}

std::array<double, 3> sunlight(const AirTables& tables, double height_km, double sun_cosine) {
    float share[3];
    sunlight_at(tables, kEarthRadiusKm + (height_km > 0 ? height_km : 0), sun_cosine, share);
    return {double(share[0]), double(share[1]), double(share[2])};
}

}  // namespace pileus
