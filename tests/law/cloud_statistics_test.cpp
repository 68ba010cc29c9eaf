// SPDX-License-Identifier: Apache-2.0
// The measures of clouds on shapes whose answers are known.
// in: a disc, a Koch snowflake, level sets of noise, waves -> out: pass or fail.
// docs/generators.md, "Measured"; Mandelbrot 1982, "The fractal geometry of nature".
#include "lab/statistics/cloud_statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/hashed_number.h"

using namespace pileus;

namespace {

constexpr double kTurn = 6.283185307179586;

/// Depths of a shape: far above the threshold inside, 0 outside, by 4 x 4 points a cell.
template <class Inside>
Plane plane_of(int n, Inside inside) {
    Plane p(n, n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (int i = 0; i < 16; ++i)
                if (inside(x + (i % 4 + 0.5) / 4, y + (i / 4 + 0.5) / 4)) p.cell(x, y) += 2.0 / 16;
    return p;
}

struct Point {
    double x, y;
};

/// A Koch snowflake around the middle of n x n cells, each side turned in four so many times.
std::vector<Point> snowflake(double n, int times) {
    std::vector<Point> line;
    for (int i = 0; i < 3; ++i) {
        const double turn = -kTurn * i / 3 + 0.1;
        line.push_back({n / 2 + 0.4 * n * std::cos(turn), n / 2 + 0.4 * n * std::sin(turn)});
    }
    for (; times > 0; --times) {
        std::vector<Point> next;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const Point a = line[i], b = line[(i + 1) % line.size()];
            const double x = (b.x - a.x) / 3, y = (b.y - a.y) / 3, h = std::sqrt(3.0) / 2;
            next.push_back(a);
            next.push_back({a.x + x, a.y + y});
            next.push_back({a.x + 1.5 * x - h * y, a.y + 1.5 * y + h * x});
            next.push_back({a.x + 2 * x, a.y + 2 * y});
        }
        line = next;
    }
    return line;
}

/// Marks the inside of a closed line: rows of 4 n points, by where they cross it.
Plane filled(int n, const std::vector<Point>& line) {
    Plane p(n, n);
    for (int row = 0; row < 4 * n; ++row) {
        const double y = (row + 0.5) / 4;
        std::vector<bool> toggles(std::size_t(4 * n) + 1);
        for (std::size_t i = 0; i < line.size(); ++i) {
            const Point a = line[i], b = line[(i + 1) % line.size()];
            if ((a.y > y) == (b.y > y)) continue;
            const double x = 4 * (a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
            const std::size_t at = std::size_t(std::fmin(std::fmax(x + 0.5, 0), 4.0 * n));
            toggles[at] = !toggles[at];
        }
        bool inside = false;
        for (int x = 0; x < 4 * n; ++x) {
            if (toggles[std::size_t(x)]) inside = !inside;
            if (inside) p.cell(x / 4, row / 4) += 2.0 / 16;
        }
    }
    return p;
}

}  // namespace

TEST_CASE("statistics: a disc's outline has dimension 1 and the length of a circle") {
    const Plane disc = plane_of(256, [](double x, double y) {
        return (x - 127.3) * (x - 127.3) + (y - 128.6) * (y - 128.6) < 90.0 * 90;
    });
    const double d = outline_dimension(disc, 1);
    std::printf("statistics: disc, dimension %.4f\n", d);
    CHECK(d == doctest::Approx(1.0).epsilon(0.005));
    CHECK(contour_length(disc, 1) == doctest::Approx(kTurn * 90).epsilon(0.005));
    const std::vector<Patch> parts = patches(disc, 1);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0].area == doctest::Approx(kTurn / 2 * 90 * 90).epsilon(0.01));
    CHECK(parts[0].length == doctest::Approx(contour_length(disc, 1)).epsilon(1e-12));
    CHECK(std::isnan(outline_dimension(Plane(20, 20), 1)));
}

TEST_CASE("statistics: a Koch snowflake's outline has dimension log 4 / log 3") {
    const double d = outline_dimension(filled(512, snowflake(512, 6)), 1);
    std::printf("statistics: Koch snowflake, dimension %.4f, exact 1.2619\n", d);
    CHECK(d == doctest::Approx(1.262).epsilon(0.025));
}

TEST_CASE("statistics: discs of many sizes have perimeter-area dimension 1") {
    Plane p(400, 400);
    for (int i = 0; i < 16; ++i) {
        const double cx = 50 + 100 * (i % 4), cy = 50 + 100 * (i / 4), r = 4 + 2.5 * i;
        for (int y = 0; y < 400; ++y)
            for (int x = 0; x < 400; ++x)
                if ((x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r) p.cell(x, y) = 2;
    }
    const std::vector<Patch> parts = patches(p, 1);
    CHECK(parts.size() == 16);
    CHECK(perimeter_area_dimension(parts) == doctest::Approx(1.0).epsilon(0.03));
    // What reaches the rim is cut, and left out.
    for (int y = 0; y < 400; ++y) p.cell(0, y) = 2;
    CHECK(patches(p, 1).size() == 16);
}

TEST_CASE("statistics: waves of falling power have its slope") {
    constexpr int kN = 256;
    for (const double slope : {-5.0 / 3, -3.0}) {
        Plane p(kN, 8);
        for (int y = 0; y < 8; ++y)
            for (int k = 1; k < kN / 2; ++k) {
                const double phase = kTurn * double(test::number(std::size_t(y * kN + k), 3));
                for (int x = 0; x < kN; ++x)
                    p.cell(x, y) +=
                        std::pow(double(k), slope / 2) * std::cos(kTurn * k * x / kN + phase);
            }
        CHECK(spectrum_slope(p, false) == doctest::Approx(slope).epsilon(0.03));
    }
    CHECK(std::isnan(spectrum_slope(Plane(16, 16), true)));
}

TEST_CASE("statistics: layers, cover and water of a slab") {
    // 0.18 /m at a height of 1 km is all the water there is.
    std::vector<float> value(4 * 4 * 10, 0.0f);
    for (int z = 2; z < 8; ++z)
        for (int i = 0; i < 8; ++i)
            value[std::size_t(z * 16 + i)] =
                float(0.5 * 0.18 * std::pow((z - 2 + 0.5) * 100 / 1000, 21.0 / 32));
    ExtinctionGrid grid{{4, 4, 10}, {50, 50, 100}, value.data()};
    const CloudStatistics s = cloud_statistics(grid);
    CHECK(s.base_m == 200);
    CHECK(s.cover == 0.5);
    REQUIRE(s.by_height.size() == 6);
    for (const HeightRow& row : s.by_height) {
        CHECK(row.cover == 0.5);
        CHECK(row.adiabatic == doctest::Approx(0.5).epsilon(1e-5));
    }
    CHECK(s.by_height[0].height_m == 50);
}
