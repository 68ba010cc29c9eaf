// SPDX-License-Identifier: Apache-2.0
// Rays through boxes at their worst: sheets, steps of any size, planes, corners, signs of zero.
// in: grids made by hand and single rays -> out: optical depths against sums along the ray.
// docs/testing.md S14, S34, S40-S44, S49.
#include "kernels_cpu/display/march.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "src/world/majorant/majorant.h"

using namespace pileus;

namespace {

constexpr double kPiDouble = 3.14159265358979324;

/// A density with blocks of one voxel, and rays through it by the march.
struct Field {
    Grid grid{};
    std::vector<float> density;
    Buffer<float> majorants;
    MediumView view{};

    Field(int nx, int ny, int nz, float ex, float ey, float ez, float sigma) {
        const int n[3] = {nx, ny, nz};
        const float e[3] = {ex, ey, ez};
        for (int a = 0; a < 3; ++a) {
            grid.size[a] = view.size[a] = n[a];
            grid.cell_m[a] = view.cell[a] = e[a] / float(n[a]);
            view.extent[a] = e[a];
        }
        view.sigma = sigma;
        view.step = std::fmin(view.cell[0], std::fmin(view.cell[1], view.cell[2]));
        density.assign(voxel_count(grid), 1.0f);
        close();
    }
    /// Call after changing the density.
    void close() {
        REQUIRE(majorant_grid({density.data(), density.size()}, grid, 1, 1, majorants));
        block_counts(grid, 1, view.blocks);
        view.block = 1;
        view.density = density.data();
        view.majorant = majorants.data();
    }
    float depth(const Vec<float>& o, const Vec<float>& d) const {
        return optical_depth(view, Ray<float>{o, d}, I_of<float>(1) == 1);
    }
};

Vec<float> unit(double x, double y, double z) {
    const double n = std::sqrt(x * x + y * y + z * z);
    return {float(x / n), float(y / n), float(z / n)};
}

}  // namespace

TEST_CASE("S14, S34: a box's optical depth is sigma L in any grid, from 1e-6 to 40") {
    const int sizes[][3] = {{1, 1, 1}, {2, 2, 2}, {7, 7, 7}, {64, 64, 64}, {37, 53, 11}};
    double worst = 0, alpha = 0;
    for (const auto& n : sizes)
        for (double tau : {1e-6, 1e-4, 1e-2, 1.0, 10.0, 40.0}) {
            const Field f(n[0], n[1], n[2], 40, 40, 40, float(tau / 40));
            const double got = double(f.depth({20, 20, -7}, {0, 0, 1}));
            worst = std::max(worst, std::fabs(got / tau - 1));
            alpha =
                std::max(alpha, std::fabs(double(one_minus_exp(float(got))) + std::expm1(-tau)));
            // Askew: from the middle of one face to a point of another.
            const double askew = double(f.depth({20, 20, 0}, unit(20, 10, 30)));
            const double length = 20 * std::sqrt(20 * 20 + 10 * 10 + 30 * 30.0) / 20;
            worst = std::max(worst, std::fabs(askew / (tau / 40 * length) - 1));
        }
    std::printf("optical depth of boxes: worst relative error %.2g, of alpha %.2g\n", worst, alpha);
    CHECK(worst <= 2e-6);  // a sum of up to 100 floats, each half an ulp
    CHECK(alpha <= 1e-6);
}

TEST_CASE("S40: a sheet one voxel thick of optical depth 50 is never seen through") {
    // Between voxel centres the density is a hat: its integral across is sigma times one cell.
    Field f(9, 9, 9, 90, 90, 90, 5);
    std::size_t v = 0;
    for (int z = 0; z < 9; ++z)
        for (int i = 0; i < 81; ++i, ++v) f.density[v] = z == 4 ? 1.0f : 0.0f;
    f.close();
    CHECK(double(f.depth({45, 45, 100}, {0, 0, -1})) == doctest::Approx(50).epsilon(1e-6));
    CHECK(double(f.depth({45, 45, -3}, {0, 0, 1})) == doctest::Approx(50).epsilon(1e-6));
    for (double mu : {0.9, 0.5, 0.2, 0.05, 1e-2, 1e-3, 1e-6}) {
        // Through the middle of the sheet: all of it, or what lies between the sides.
        const Vec<float> d = unit(std::sqrt(1 - mu * mu), 0, -mu);
        const Vec<float> o{45 - d.x * 200, 45, 45 - d.z * 200};
        const double tau = double(f.depth(o, d));
        std::printf("sheet at mu %g: optical depth %.4g\n", mu, tau);
        // More than 60 is given up as opaque; the lattice of steps errs by a share of a step.
        CHECK(tau >= std::fmin(50 / mu * 0.9, 60.0));
        CHECK(one_minus_exp(float(tau)) == 1.0f);
    }

    // Halving the step converges at first order or better, down to the rounding of positions.
    const Vec<float> d = unit(0.6, 0.1, -0.8), o{30, 40, 95};
    f.view.sigma = 0.05f;
    const double exact = 0.05 * 10 / double(-d.z);
    for (float step : {10.0f, 5.0f, 2.5f, 1.25f, 0.625f}) {
        f.view.step = step;
        const double error = std::fabs(double(f.depth(o, d)) - exact);
        std::printf("sheet, step %g m: error %.2g of %.3g\n", double(step), error, exact);
        CHECK(error <= exact * (0.03 * double(step) / 10 + 1e-4));
    }
}

TEST_CASE("S41: steps longer than the box, tiny ones, and flat boxes end in bounded work") {
    // A flat voxel sets the step: along the box there would be 10^9 of them.
    for (float flat : {1e-1f, 1e-3f, 1e-6f}) {
        const Field f(4, 4, 1, 1e5f, 1e5f, flat, 1e-5f);
        const double tau = double(f.depth({-1, 5e4f, 0.5f * flat}, {1, 0, 0}));
        // 8192 additions, half an ulp or 2^-25 of the sum each.
        CHECK(tau == doctest::Approx(1.0).epsilon(8192 * 0x1p-25));
    }
    Field f(8, 8, 8, 8, 8, 8, 0.25f);
    for (float step : {1e-12f, 1e-9f, 1e-6f, 1e3f, 1e30f}) {
        f.view.step = step;
        const double tau = double(f.depth({4, 4, -1}, {0, 0, 1}));
        std::printf("step %g m: optical depth %.7g of 2\n", double(step), tau);
        CHECK(tau == doctest::Approx(2.0).epsilon(8192 * 0x1p-25));
    }
}

TEST_CASE("S42: optical depth from A to B is that from B to A") {
    Field f(16, 12, 10, 16, 12, 10, 0.3f);
    for (std::size_t v = 0; v < f.density.size(); ++v) f.density[v] = float(v * 7 % 11) / 10;
    f.close();
    struct Line {
        Vec<float> a, b;
    };
    // Along axes the steps fall on the same middles from both ends; elsewhere the last step is a
    // part of one, and the two sums differ by what one step of the lattice can.
    const Line lines[] = {{{0, 6, 5}, {16, 6, 5}},   {{8, 0, 5}, {8, 12, 5}},
                          {{8, 6, 0}, {8, 6, 10}},   {{3.5f, 2.5f, 0}, {3.5f, 2.5f, 10}},
                          {{0, 0, 5}, {16, 0, 5}},   {{16, 12, 0}, {16, 12, 10}},
                          {{0, 0, 0}, {16, 12, 10}}, {{16, 0, 0}, {0, 12, 10}},
                          {{0, 1, 0}, {10, 11, 10}}, {{2, 0, 0}, {12, 10, 10}}};
    for (std::size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) {
        const Line& l = lines[i];
        const Vec<float> d =
            unit(double(l.b.x - l.a.x), double(l.b.y - l.a.y), double(l.b.z - l.a.z));
        const double there = double(f.depth(l.a, d));
        const double back = double(f.depth(l.b, {-d.x, -d.y, -d.z}));
        INFO("line ", i, ": ", there, " and ", back);
        CHECK(std::isfinite(there));
        CHECK(std::fabs(there - back) <= (i < 6 ? 1e-5 : 0.3));
    }
}

TEST_CASE("S43: rays in the box's planes, with either sign of zero") {
    const float extent[3] = {4, 4, 4};
    const float inf = std::numeric_limits<float>::infinity();
    for (float x : {0.0f, -0.0f, 4.0f, 1.0f, 2.0f, -1.0f, 5.0f})
        for (float z : {0.0f, 4.0f, -3.0f, 2.0f}) {
            const Segment<float> plus =
                clip_to_box(Vec<float>{x, 2, z}, Vec<float>{0.0f, 0.0f, 1.0f}, extent);
            const Segment<float> minus =
                clip_to_box(Vec<float>{x, 2, z}, Vec<float>{-0.0f, -0.0f, 1.0f}, extent);
            INFO("x ", x, " z ", z);
            CHECK_FALSE(std::isnan(plus.enter));
            CHECK_FALSE(std::isnan(plus.leave));
            const bool hit = plus.enter < plus.leave, other = minus.enter < minus.leave;
            CHECK(hit == other);
            if (hit) {
                CHECK(plus.enter == minus.enter);
                CHECK(plus.leave == minus.leave);
            }
            if (x < 0 || x > 4) CHECK_FALSE(hit);
            if (x == 1 || x == 2) CHECK(hit == (z < 4));
            CHECK(plus.enter < inf);
        }
    // Through a lattice point along the diagonal, from a corner and from beyond one.
    for (float from : {0.0f, -2.0f, -1e6f}) {
        const Segment<float> s = clip_to_box(Vec<float>{from, from, from}, unit(1, 1, 1), extent);
        CHECK(double(s.leave - s.enter) ==
              doctest::Approx(4 * std::sqrt(3.0)).epsilon(from < -10 ? 0.05 : 1e-6));
    }
}

TEST_CASE("S49: the solid angles of a cube face's pixels add up to 4 pi / 6") {
    CameraParams c{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1, 1, 512, 512, 0};
    double sum = 0;
    for (int y = 0; y < c.height; ++y)
        for (int x = 0; x < c.width; ++x) {
            const Ray<float> r = camera_ray(c, float(x), float(y));
            const double cosine = double(r.direction.y);
            sum += cosine * cosine * cosine * 4.0 / (512.0 * 512.0);
        }
    std::printf("cube face: %.9g of %.9g\n", sum, 4 * kPiDouble / 6);
    CHECK(std::fabs(sum / (4 * kPiDouble / 6) - 1) <= 1e-5);
}
