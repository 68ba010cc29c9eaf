// SPDX-License-Identifier: Apache-2.0
// See air_tables.h. Directions are fixed ones about the local vertical and the sun's azimuth; a
// pass carries what all of them send through the air and gathers it again as harmonics.
#include <vector>

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/world/atmosphere/air_column.h"
#include "src/world/atmosphere/air_tables.h"

namespace pileus {
namespace {

double held(double v, double low, double high) { return v < low ? low : v > high ? high : v; }
double root(double v) { return v > 0 ? __builtin_sqrt(v) : 0; }

constexpr double kLowestColumn = -0.6;
constexpr int kPasses = 5, kSteps = 16;
constexpr int kEntries = kAroundRows * kAroundColumns;

double row_height(int i) {
    const double x = double(i) / (kAroundRows - 1);
    return (kAirTopKm - kEarthRadiusKm) * x * x;
}
double column_sun(int i) {
    const double x = kLowestColumn + (1 - kLowestColumn) * i / (kAroundColumns - 1);
    return x < 0 ? -x * x : x * x;
}

// Gauss's rule for each half of the cosines; azimuths in the middles of a half turn's parts.
constexpr int kUps = 6, kTurns = 6, kZeniths = 2 * kUps, kWays = kZeniths * kTurns;
constexpr double kNodes[kUps] = {0.0337652428984240, 0.1693953067668677, 0.3806904069584016,
                                 0.6193095930415985, 0.8306046932331323, 0.9662347571015760};
constexpr double kWeights[kUps] = {0.0856622461895852, 0.1803807865240693, 0.2339569672863455,
                                   0.2339569672863455, 0.1803807865240693, 0.0856622461895852};

double zenith_cosine(int z) { return z < kUps ? kNodes[z] : -kNodes[z - kUps]; }
double turn_cosine(int turn) { return sincos_deg(180.0 * (turn + 0.5) / kTurns).cosine; }

/// One step of a ray from a row's height: what is seen of a source there, by air and by haze.
struct Step {
    double at, along;  ///< km from the earth's middle, km along the ray
    float by_air[3], by_haze[3];
};
/// A ray for all suns.
struct Ray {
    double r, cosine;
    Step steps[kSteps];
    bool hits = false;
    double length = 0;
    float left[3] = {1, 1, 1};
};

Ray make_ray(const Air& air, int row, int zenith) {
    Ray ray;
    // Neither within the ground nor on the very top.
    ray.r = kEarthRadiusKm + held(row_height(row), 1e-3, 99.99);
    ray.cosine = zenith_cosine(zenith);
    const double ground = way_to_sphere(ray.r, ray.cosine, kEarthRadiusKm, false);
    ray.hits = ground >= 0 && ray.cosine < 0;
    ray.length = ray.hits ? ground : way_to_sphere(ray.r, ray.cosine, kAirTopKm, true);
    AirWalk walk(ray.r, ray.cosine, 0);
    double before = 0;
    for (int i = 0; i < kSteps; ++i) {
        Step& s = ray.steps[i];
        const double end = ray.length * step_end((i + 1.0) / kSteps, ray.hits);
        s.along = 0.5 * (before + end);
        s.at = __builtin_sqrt(ray.r * ray.r + s.along * s.along + 2 * ray.r * s.along * ray.cosine);
        const AirPiece piece = piece_of(air, walk.to(end));
        for (int c = 0; c < 3; ++c) {
            s.by_air[c] = ray.left[c] * piece.by_air[c];
            s.by_haze[c] = ray.left[c] * piece.by_haze[c];
            ray.left[c] *= piece.left[c];
        }
        before = end;
    }
    return ray;
}

/// What a pass works on.
struct Orders {
    AirTables& tables;
    std::vector<Ray> rays;     ///< [row][zenith]
    Buffer<float> first, all;  ///< [way][entry][3]
    float y[kWays][kAirTerms];

    const Ray& ray(int row, int zenith) const {
        return rays[std::size_t(row) * kZeniths + std::size_t(zenith)];
    }
    float* at(Buffer<float>& b, int way, int entry) {
        return b.data() + 3 * (std::ptrdiff_t(way) * kEntries + entry);
    }
};

/// Cosine between a direction and the sun.
double along_sun(int way, double sun) {
    const double cosine = zenith_cosine(way / kTurns);
    return cosine * sun + root((1 - cosine * cosine) * (1 - sun * sun)) * turn_cosine(way % kTurns);
}

/// Scattered once on the way, and sent back by the sunlit ground.
void first_order(Orders& o, int way) {
    const Air& air = o.tables.air;
    for (int entry = 0; entry < kEntries; ++entry) {
        const Ray& ray = o.ray(entry / kAroundColumns, way / kTurns);
        const double sun = column_sun(entry % kAroundColumns), along = along_sun(way, sun);
        const float by_air = air_phase(float(along));
        const float by_haze = haze_phase(air.haze_g, float(along));
        float* out = o.at(o.first, way, entry);
        for (int c = 0; c < 3; ++c) out[c] = 0;
        float light[3];
        for (const Step& s : ray.steps) {
            sunlight_at(o.tables, s.at, (ray.r * sun + s.along * along) / s.at, light);
            for (int c = 0; c < 3; ++c)
                out[c] += (s.by_air[c] * by_air + s.by_haze[c] * by_haze) * light[c];
        }
        if (!ray.hits) continue;
        const double mu = (ray.r * sun + ray.length * along) / kEarthRadiusKm;
        sunlight_at(o.tables, kEarthRadiusKm, mu, light);
        for (int c = 0; c < 3; ++c)
            out[c] += ray.left[c] * air.ground * float(mu > 0 ? mu : 0) * light[c] / kPi;
    }
}

/// Harmonics of what comes to an entry from all ways, and what the ground gets of it.
void gather(Orders& o, int entry) {
    float* out = o.tables.around.data() + std::ptrdiff_t(4 * kAirTerms) * entry;
    for (int i = 0; i < 4 * kAirTerms; ++i) out[i] = 0;
    double level[3] = {};
    for (int way = 0; way < kWays; ++way) {
        const double weight = kWeights[way / kTurns % kUps] * kTwoPi64 / kTurns;
        const float* light = o.at(o.all, way, entry);
        for (int term = 0; term < kAirTerms; ++term)
            for (int c = 0; c < 3; ++c)
                out[4 * term + c] += float(weight) * o.y[way][term] * light[c];
        const double up = zenith_cosine(way / kTurns);
        for (int c = 0; c < 3 && up > 0; ++c) level[c] += weight * up * double(light[c]);
    }
    if (entry >= kAroundColumns) return;
    for (int copy = 0; copy < 2; ++copy)
        for (int c = 0; c < 3; ++c)
            o.tables.ground[std::size_t(4 * (copy * kAroundColumns + entry) + c)] = float(level[c]);
}

/// What air and haze at every entry send one way.
void sources(const Orders& o, int way, float* by_air, float* by_haze) {
    const float g = o.tables.air.haze_g;
    for (int entry = 0; entry < kEntries; ++entry) {
        const float* in = o.tables.around.data() + std::ptrdiff_t(4 * kAirTerms) * entry;
        float air[3] = {}, haze[3] = {}, power = 1;
        for (int degree = 0, term = 0; degree < kAirBands; ++degree, power *= g) {
            const float share = degree == 0 ? 1.0f : degree == 2 ? 0.1f : 0.0f;
            for (int order = 0; order <= degree; ++order, ++term)
                for (int c = 0; c < 3; ++c) {
                    const float v = o.y[way][term] * in[4 * term + c];
                    air[c] += share * v, haze[c] += power * v;
                }
        }
        for (int c = 0; c < 3; ++c) {
            by_air[3 * entry + c] = air[c] > 0 ? air[c] : 0;
            by_haze[3 * entry + c] = haze[c] > 0 ? haze[c] : 0;
        }
    }
}

/// One more pass of all the light along one way.
void pass(Orders& o, int way) {
    const Air& air = o.tables.air;
    float by_air[3 * kEntries], by_haze[3 * kEntries];
    sources(o, way, by_air, by_haze);
    for (int entry = 0; entry < kEntries; ++entry) {
        const Ray& ray = o.ray(entry / kAroundColumns, way / kTurns);
        const double sun = column_sun(entry % kAroundColumns), along = along_sun(way, sun);
        float* out = o.at(o.all, way, entry);
        const float* once = o.at(o.first, way, entry);
        for (int c = 0; c < 3; ++c) out[c] = once[c];
        for (const Step& s : ray.steps) {
            const double row = around_row(s.at - kEarthRadiusKm) * (kAroundRows - 1);
            const double column =
                around_column((ray.r * sun + s.along * along) / s.at) * (kAroundColumns - 1);
            const int y0 = row < kAroundRows - 2 ? int(row) : kAroundRows - 2;
            const int x0 = column < kAroundColumns - 2 ? int(column) : kAroundColumns - 2;
            const float fy = float(row - y0), fx = float(column - x0);
            const float w[4] = {(1 - fy) * (1 - fx), (1 - fy) * fx, fy * (1 - fx), fy * fx};
            const int first = 3 * (y0 * kAroundColumns + x0), next = first + 3 * kAroundColumns;
            for (int c = 0; c < 3; ++c) {
                const auto mixed = [&](const float* table) {
                    return table[first + c] * w[0] + table[first + 3 + c] * w[1] +
                           table[next + c] * w[2] + table[next + 3 + c] * w[3];
                };
                out[c] += s.by_air[c] * mixed(by_air) + s.by_haze[c] * mixed(by_haze);
            }
        }
        if (!ray.hits) continue;
        float level[3];
        ground_light(o.tables, float((ray.r * sun + ray.length * along) / kEarthRadiusKm), level);
        for (int c = 0; c < 3; ++c) out[c] += ray.left[c] * air.ground * level[c] / kPi;
    }
}

/// All further passes at once: each adds a part of the one before, by channel the same in all
/// directions.
void close(const Buffer<float>& before, const Buffer<float>& last, AirTables& t) {
    for (int entry = 0; entry < kEntries; ++entry) {
        const std::size_t at = std::size_t(4 * kAirTerms * entry);
        for (std::size_t c = 0; c < 3; ++c) {
            const float late = t.around[at + c] - last[at + c],
                        early = last[at + c] - before[at + c];
            const float ratio = early > 0 && late > 0 ? late / early : 0;
            const float more = ratio < 0.9f ? ratio / (1 - ratio) : 9.0f;
            for (std::size_t term = 0; term < kAirTerms; ++term) {
                float& v = t.around[at + 4 * term + c];
                v += more * (v - last[at + 4 * term + c]);
            }
        }
    }
}

Status copy_of(const Buffer<float>& from, Buffer<float>& to) {
    PILEUS_TRY(to.resize(from.size(), "air"));
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i];
    return Status::ok();
}

}  // namespace

double around_row(double height_km) {
    return root(held(height_km / (kAirTopKm - kEarthRadiusKm), 0, 1));
}
double around_column(double sun_cosine) {
    const double x = sun_cosine < 0 ? -root(-sun_cosine) : root(sun_cosine);
    return held((x - kLowestColumn) / (1 - kLowestColumn), 0, 1);
}

void air_harmonics(double cosine, double east, float (&y)[kAirTerms]) {
    const double side = root(1 - cosine * cosine);
    // Legendre functions by rising degree, cosines of multiples by Chebyshev's recurrence.
    double p[kAirBands][kAirBands] = {}, turns[kAirBands] = {1, east};
    for (int m = 2; m < kAirBands; ++m) turns[m] = 2 * east * turns[m - 1] - turns[m - 2];
    p[0][0] = 1;
    for (int m = 1; m < kAirBands; ++m) p[m][m] = p[m - 1][m - 1] * (2 * m - 1) * side;
    for (int m = 0; m + 1 < kAirBands; ++m) p[m + 1][m] = (2 * m + 1) * cosine * p[m][m];
    for (int m = 0; m < kAirBands; ++m)
        for (int l = m + 2; l < kAirBands; ++l)
            p[l][m] = ((2 * l - 1) * cosine * p[l - 1][m] - (l + m - 1) * p[l - 2][m]) / (l - m);
    for (int l = 0, term = 0; l < kAirBands; ++l)
        for (int m = 0; m <= l; ++m, ++term) {
            double size = (2 * l + 1) / (2 * kTwoPi64) * (m > 0 ? 2 : 1);
            for (int k = l - m + 1; k <= l + m; ++k) size /= k;
            y[term] = float(root(size) * p[l][m] * turns[m]);
        }
}

Status add_orders(int threads, AirTables& t) {
    Orders o{t, {}, {}, {}, {}};
    PILEUS_TRY(t.around.resize(std::size_t{4} * kAirTerms * kEntries, "air"));
    PILEUS_TRY(t.ground.resize(std::size_t{8} * kAroundColumns, "air"));
    PILEUS_TRY(o.first.resize(std::size_t{3} * kWays * kEntries, "air"));
    PILEUS_TRY(o.all.resize(std::size_t{3} * kWays * kEntries, "air"));
    for (int row = 0; row < kAroundRows; ++row)
        for (int z = 0; z < kZeniths; ++z) o.rays.push_back(make_ray(t.air, row, z));
    for (int way = 0; way < kWays; ++way)
        air_harmonics(zenith_cosine(way / kTurns), turn_cosine(way % kTurns), o.y[way]);
    parallel_for(threads, kWays, [&](std::int64_t way, int) { first_order(o, int(way)); });
    PILEUS_TRY(copy_of(o.first, o.all));
    Buffer<float> before, last;
    PILEUS_TRY(before.resize(t.around.size(), "air"));
    PILEUS_TRY(last.resize(t.around.size(), "air"));
    for (int i = 0; i <= kPasses; ++i) {
        if (i > 0) parallel_for(threads, kWays, [&](std::int64_t way, int) { pass(o, int(way)); });
        before.swap(last);
        for (std::size_t k = 0; k < last.size(); ++k) last[k] = t.around[k];
        parallel_for(threads, kEntries, [&](std::int64_t entry, int) { gather(o, int(entry)); });
    }
    close(before, last, t);
    return Status::ok();
}

}  // namespace pileus
