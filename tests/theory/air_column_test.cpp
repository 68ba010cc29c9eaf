// SPDX-License-Identifier: Apache-2.0
// Columns of air, haze and ozone against fine sums along the way, in round and in level air.
// in: heights, directions, turbidities -> out: relative errors. docs/atmosphere.md, "Columns"
#include "src/world/atmosphere/air_column.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "src/base/angles.h"
#include "src/world/atmosphere/air_sky.h"

using namespace pileus;

namespace {

double sine_of(double degrees) { return std::sin(degrees * kPi64 / 180); }

double tent(double height) {
    const double away = std::fabs(height - double(kOzoneHeightKm)) / double(kOzoneHalfKm);
    return away < 1 ? 1 - away : 0;
}

/// Simpson's rule over `count` parts.
template <class F>
double simpson(double from, double to, int count, const F& f) {
    const double h = (to - from) / (2 * count);
    double sum = f(from) + f(to);
    for (int i = 1; i < 2 * count; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * h);
    return sum * h / 3;
}

/// To 200 km above the ground: what is beyond is below 1e-10 of a column. Parts grow from the least
/// height on, by the square.
AirColumn summed(double height, double cosine) {
    const double r = kEarthRadiusKm + height, level = r * cosine;
    const double square = r * r * (1 - cosine * cosine), top = kEarthRadiusKm + 200;
    const double end = std::sqrt(top * top - square);
    const auto along = [&](double from, double to, const auto& density) {
        const double first = std::sqrt(from), last = std::sqrt(to);
        return simpson(first, last, 20000, [&](double u) {
            const double t = u * u;
            return 2 * u * density(std::sqrt(square + t * t) - kEarthRadiusKm);
        });
    };
    const auto column = [&](const auto& density) {
        const double outward = along(std::fabs(level), end, density);
        return level < 0 ? along(0, -level, density) * 2 + outward : outward;
    };
    return {column([](double h) { return std::exp(-h / double(kAirScaleKm)); }),
            column([](double h) { return std::exp(-h / double(kHazeScaleKm)); }), column(tent)};
}

double error_of(double found, double right) {
    return right > 0 ? std::fabs(found / right - 1) : std::fabs(found);
}

}  // namespace

TEST_CASE("air: columns straight up are the scale heights, that of ozone half its width") {
    const AirColumn up = column_to_space(kEarthRadiusKm, 1);
    CHECK(up.air == doctest::Approx(double(kAirScaleKm)).epsilon(1e-4));
    CHECK(up.haze == doctest::Approx(double(kHazeScaleKm)).epsilon(1e-4));
    CHECK(up.ozone == doctest::Approx(double(kOzoneHalfKm)).epsilon(1e-6));
    // Along the level Chapman's function is X e^X K1(X): sqrt(pi X / 2) (1 + 3 / 8X - 15 / 128X^2).
    const double X = kEarthRadiusKm / double(kAirScaleKm);
    const double level = std::sqrt(kPi64 * X / 2) * (1 + 3 / (8 * X) - 15 / (128 * X * X));
    CHECK(column_to_space(kEarthRadiusKm, 0).air ==
          doctest::Approx(double(kAirScaleKm) * level).epsilon(1e-4));
}

TEST_CASE("air: columns to space are right within 1e-4, whatever the height and the direction") {
    for (const double height : {0.0, 0.3, 1.0, 2.5, 5.0, 10.0, 12.0, 20.0, 30.0, 60.0})
        for (const double elevation : {-8.0, -4.0, -3.0, -2.0, -1.0, -0.5, 0.0, 0.2, 0.5, 1.0, 2.0,
                                       5.0, 10.0, 20.0, 45.0, 70.0, 90.0}) {
            const double cosine = sine_of(elevation), r = kEarthRadiusKm + height;
            const double least = r * std::sqrt(1 - cosine * cosine);
            if (elevation < 0 && least < kEarthRadiusKm) continue;
            CAPTURE(height);
            CAPTURE(elevation);
            const AirColumn found = column_to_space(r, cosine), right = summed(height, cosine);
            CHECK(error_of(found.air, right.air) < 1e-4);
            CHECK(error_of(found.haze, right.haze) < 1e-4);
            // The sum has kinks at the tent's ends and top: 1e-5 of it.
            CHECK(std::fabs(found.ozone - right.ozone) < 1e-5 * right.ozone + 1e-6);
        }
}

TEST_CASE("air: sunlight is right within half a per cent, turbidity 1 to 10, heights to 20 km") {
    // Of what is left, down to e^-50: depths err by 1e-4 of themselves. The sun's disc is all above
    // the horizon in these.
    for (const double turbidity : {1.0, 2.0, 4.0, 10.0}) {
        AirTables tables;
        tables.air = make_air(turbidity, 0.2);
        const Air& air = tables.air;
        for (const double height : {0.0, 0.5, 2.0, 7.0, 12.0, 20.0})
            for (const double elevation : {-1.0, 0.3, 1.0, 3.0, 10.0, 30.0, 90.0}) {
                const double cosine = sine_of(elevation);
                const double r = kEarthRadiusKm + height;
                if (r * std::sqrt(1 - cosine * cosine) < kEarthRadiusKm + 0.01 && elevation < 0)
                    continue;
                const AirColumn right = summed(height, cosine);
                const std::array<double, 3> found = sunlight(tables, height, cosine);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double depth = double(air.rayleigh[c]) * right.air +
                                         double(air.haze_all[c]) * right.haze +
                                         double(air.ozone[c]) * right.ozone;
                    CAPTURE(turbidity);
                    CAPTURE(height);
                    CAPTURE(elevation);
                    if (depth < 50) CHECK(error_of(found[c], std::exp(-depth)) < 0.005);
                }
            }
    }
}

TEST_CASE("air: pieces of a way add up to its column, through its lowest place, too") {
    struct Row {
        double height, elevation, end;
    };
    for (const Row row : {Row{0, 0, 900}, Row{5, -1, 700}, Row{12, -3, 400}, Row{20, -20, 55},
                          Row{0.2, 60, 100}, Row{20, -90, 19.9}}) {
        const double cosine = sine_of(row.elevation), r = kEarthRadiusKm + row.height;
        AirWalk walk(r, cosine, 0);
        AirColumn sum{};
        constexpr int kParts = 37;
        for (int i = 1; i <= kParts; ++i) {
            const AirColumn part = walk.to(row.end * i / kParts);
            sum.air += part.air, sum.haze += part.haze, sum.ozone += part.ozone;
        }
        const auto column = [&](const auto& density) {
            return simpson(0, row.end, 40000, [&](double t) {
                const double square = r * r + t * t + 2 * r * t * cosine;
                return density(std::sqrt(square) - kEarthRadiusKm);
            });
        };
        CAPTURE(row.height);
        CAPTURE(row.elevation);
        const double air = column([](double h) { return std::exp(-h / double(kAirScaleKm)); });
        const double haze = column([](double h) { return std::exp(-h / double(kHazeScaleKm)); });
        CHECK(error_of(sum.air, air) < 2e-4);
        CHECK(error_of(sum.haze, haze) < 2e-4);
        CHECK(std::fabs(sum.ozone - column(tent)) < 1e-4);
    }
}

TEST_CASE("air: level columns between two heights are closed forms to a float's rounding") {
    for (const double from : {-1.0, 0.0, 0.001, 1.0, 3.0, 9.9, 20.0, 24.9, 38.0, 60.0})
        for (const double to : {0.0, 0.0011, 1.0, 1.01, 5.0, 12.0, 25.0, 26.0, 45.0}) {
            const LevelAir<float> found = level_air(float(from), float(to));
            const double low = std::fmax(std::fmin(from, to), 0),
                         high = std::fmax(std::fmax(from, to), 0);
            const auto mean = [&](const auto& density) {
                if (high - low < 1e-9) return density(low);
                return simpson(low, high, 4000, density) / (high - low);
            };
            CAPTURE(from);
            CAPTURE(to);
            const double air = mean([](double h) { return std::exp(-h / double(kAirScaleKm)); });
            const double haze = mean([](double h) { return std::exp(-h / double(kHazeScaleKm)); });
            CHECK(double(found.air) == doctest::Approx(air).epsilon(1e-5));
            CHECK(double(found.haze) == doctest::Approx(haze).epsilon(1e-5));
            CHECK(std::fabs(double(found.ozone) - mean(tent)) < 1e-4);
        }
}
