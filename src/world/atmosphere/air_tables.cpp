// SPDX-License-Identifier: Apache-2.0
// See air_tables.h. Sunlight by height and direction, and reading the tables; air_orders.cpp has
// the orders of scattering.
#include "src/world/atmosphere/air_tables.h"

#include "src/world/atmosphere/air_column.h"

namespace pileus {
namespace {

constexpr double kSunRadius = 0.00465;  // radians

double held(double v, double low, double high) { return v < low ? low : v > high ? high : v; }

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
    const AirPiece air = piece_of(
        t.air, column_to_space(held(r, kEarthRadiusKm, kAirTopKm), held(cosine, horizon, 1)));
    for (int c = 0; c < 3; ++c) share[c] = air.left[c] * float(shown);
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
    return add_orders(threads, tables);
}

}  // namespace pileus
