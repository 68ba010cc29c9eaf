// SPDX-License-Identifier: Apache-2.0
// See air_tables.h. Sunlight by height and direction, and reading the tables; air_orders.cpp has
// the orders of scattering.
#include "src/world/atmosphere/air_tables.h"

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"

namespace pileus {
namespace {

constexpr double kShell2 =
    kAirTopKm * kAirTopKm - kEarthRadiusKm * kEarthRadiusKm;  // horizon to the top, squared
constexpr int kColumnSteps = 48;
constexpr double kSunRadius = 0.00465;  // radians

double held(double v, double low, double high) { return v < low ? low : v > high ? high : v; }

/// Along a ray that ends at the top.
void depth_along(const Air& air, double r, double cosine, double length, float (&depth)[3]) {
    for (float& d : depth) d = 0;
    // Steps grow from the lower end, where the air is dense.
    double before = 0;
    for (int i = 0; i < kColumnSteps; ++i) {
        const double end = length * step_end((i + 1.0) / kColumnSteps, false);
        const double t = 0.5 * (before + end);
        const double at = __builtin_sqrt(r * r + t * t + 2 * r * t * cosine);
        const AirAt here = air_at(air, float(at - kEarthRadiusKm));
        for (int c = 0; c < 3; ++c) depth[c] += here.extinction[c] * float(end - before);
        before = end;
    }
}

/// Row and column of a direction that misses the ground, in [0, 1] (Bruneton & Neyret).
void place_of(double r, double cosine, double& row, double& column) {
    const double rho = __builtin_sqrt(held(r * r - kEarthRadiusKm * kEarthRadiusKm, 0, kShell2));
    const double whole = __builtin_sqrt(kShell2);
    const double way = way_to_sphere(r, cosine, kAirTopKm, true);
    const double least = kAirTopKm - r, most = rho + whole;
    row = rho / whole;
    column = most > least ? held((way - least) / (most - least), 0, 1) : 0;
}

void make_light_row(const Air& air, int row, float* out) {
    const double whole = __builtin_sqrt(kShell2);
    const double rho = whole * row / (kLightRows - 1);
    const double r = __builtin_sqrt(rho * rho + kEarthRadiusKm * kEarthRadiusKm);
    const double least = kAirTopKm - r, most = rho + whole;
    for (int i = 0; i < kLightColumns; ++i) {
        const double way = least + (most - least) * i / (kLightColumns - 1);
        const double cosine =
            way > 0 ? held((kShell2 - rho * rho - way * way) / (2 * r * way), -1, 1) : 1;
        float depth[3];
        depth_along(air, r, cosine, way, depth);
        for (int c = 0; c < 3; ++c) out[3 * i + c] = exp_(-depth[c]);
    }
}

/// Entries of a table [rows][columns][step], four of which lie around a place, and their weights.
struct Corner {
    const float* at[4];
    float weight[4];
};
Corner corner(const float* table, int rows, int columns, int step, double row, double column) {
    const double y = held(row, 0, 1) * (rows - 1), x = held(column, 0, 1) * (columns - 1);
    const int y0 = y < rows - 2 ? int(y) : rows - 2, x0 = x < columns - 2 ? int(x) : columns - 2;
    const float fy = float(y - y0), fx = float(x - x0);
    const float* a = table + std::ptrdiff_t(step) * (std::ptrdiff_t(y0) * columns + x0);
    const float* b = a + std::ptrdiff_t(step) * columns;
    return {{a, a + step, b, b + step},
            {(1 - fy) * (1 - fx), (1 - fy) * fx, fy * (1 - fx), fy * fx}};
}

float mixed(const Corner& at, int i) {
    return at.at[0][i] * at.weight[0] + at.at[1][i] * at.weight[1] + at.at[2][i] * at.weight[2] +
           at.at[3][i] * at.weight[3];
}

}  // namespace

double step_end(double share, bool from_above) {
    return from_above ? share * (2 - share) : share * share;
}

double way_to_sphere(double r, double cosine, double sphere, bool far) {
    const double b = r * cosine, q = b * b - r * r + sphere * sphere;
    if (q < 0) return -1;
    const double root = __builtin_sqrt(q);
    return far ? root - b : -b - root;
}

void sunlight_at(const AirTables& t, double r, double cosine, float (&share)[3]) {
    const double down = kEarthRadiusKm / (r > kEarthRadiusKm ? r : kEarthRadiusKm);
    const double horizon = -__builtin_sqrt(1 - down * down);
    // The share of the disc above the horizon, as a ramp.
    const double width = kSunRadius * down;
    const double shown = held((cosine - horizon + width) / (2 * width), 0, 1);
    if (shown <= 0) {
        for (float& s : share) s = 0;
        return;
    }
    double row = 0, column = 0;
    place_of(held(r, kEarthRadiusKm, kAirTopKm), held(cosine, horizon, 1), row, column);
    const Corner at = corner(t.light.data(), kLightRows, kLightColumns, 3, row, column);
    for (int c = 0; c < 3; ++c) share[c] = mixed(at, c) * float(shown);
}

void scattered_at(const AirTables& t, float height_km, float sun_cosine,
                  const float (&y)[kAirTerms], float (&by_air)[3], float (&by_haze)[3]) {
    const double row = around_row(double(height_km)), column = around_column(double(sun_cosine));
    const Corner at =
        corner(t.around.data(), kAroundRows, kAroundColumns, 4 * kAirTerms, row, column);
    float air[4] = {}, haze[4] = {};
    float g = 1;
    for (int degree = 0, term = 0; degree < kAirBands; ++degree, g *= t.air.haze_g) {
        float sum[4] = {};
        for (int order = 0; order <= degree; ++order, ++term)
            for (int c = 0; c < 4; ++c) sum[c] += y[term] * mixed(at, 4 * term + c);
        const float share = degree == 0 ? 1.0f : degree == 2 ? 0.1f : 0.0f;
        for (int c = 0; c < 4; ++c) air[c] += share * sum[c], haze[c] += g * sum[c];
    }
    // Cut off after some degrees, the sum may fall below zero where little light comes from.
    for (int c = 0; c < 3; ++c) {
        by_air[c] = air[c] > 0 ? air[c] : 0;
        by_haze[c] = haze[c] > 0 ? haze[c] : 0;
    }
}

void ground_light(const AirTables& t, float sun_cosine, float (&irradiance)[3]) {
    const Corner at =
        corner(t.ground.data(), 2, kAroundColumns, 4, 0, around_column(double(sun_cosine)));
    for (int c = 0; c < 3; ++c) irradiance[c] = mixed(at, c);
}

Status make_air_tables(const Air& air, int threads, AirTables& tables) {
    tables.air = air;
    PILEUS_TRY(tables.light.resize(std::size_t{3} * kLightRows * kLightColumns, "air"));
    parallel_for(threads, kLightRows, [&](std::int64_t row, int) {
        make_light_row(air, int(row), tables.light.data() + 3 * kLightColumns * row);
    });
    return add_orders(threads, tables);
}

}  // namespace pileus
