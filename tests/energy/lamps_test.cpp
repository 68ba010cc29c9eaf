// SPDX-License-Identifier: Apache-2.0
// Point, spot and parallel lights by paths: integrals in double precision, energy, closed forms.
// in: lights made by hand in and beside a box -> out: pass or fail.
// docs/lights.md. Statistics by check_mean: 4.5 standard errors, and 5.7 of sixteen times the
// samples.
#include <cmath>

#include "tests/support/path_harness.h"

namespace {

using namespace path_test;

constexpr double kPiD = 3.14159265358979323846;
constexpr double kEdge = 4;  // of the box, m

/// A light all around, whose irradiance at distance d is `intensity` / d^2.
LampParams point(Double3 at, double intensity, double radius = 1e-3) {
    LampParams lamp{};
    for (std::size_t a = 0; a < 3; ++a) {
        lamp.at[a] = float(at[int(a)]);
        lamp.light[a] = float(intensity);
    }
    lamp.axis[2] = -1;
    lamp.edge = -3;
    lamp.slope = 1;
    lamp.strength = float(intensity);
    lamp.least_square = float(radius * radius);
    return lamp;
}

/// The same in a cone along `axis`, soft between the cosines `full` and `edge`.
LampParams spot(Double3 at, Double3 axis, double edge, double full, double intensity) {
    LampParams lamp = point(at, intensity);
    const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (std::size_t a = 0; a < 3; ++a) lamp.axis[a] = float(axis[int(a)] / length);
    lamp.edge = float(edge);
    lamp.slope = float(1 / (full - edge));
    return lamp;
}

double shape(const LampParams& lamp, double cosine) {
    const double x =
        std::fmin(std::fmax((cosine - double(lamp.edge)) * double(lamp.slope), 0.0), 1.0);
    return x * x * (3 - 2 * x);
}

double hg(double g, double cosine) {
    const double f = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * kPiD * f * std::sqrt(f));
}

/// Metres of the segment from `a` to `b` within the box.
double within(const Double3& a, const Double3& b) {
    double enter = 0, leave = 1, square = 0;
    for (int i = 0; i < 3; ++i) {
        const double d = b[i] - a[i];
        square += d * d;
        if (d == 0) continue;
        const double x = (0 - a[i]) / d, y = (kEdge - a[i]) / d;
        enter = std::fmax(enter, std::fmin(x, y));
        leave = std::fmin(leave, std::fmax(x, y));
    }
    return leave > enter ? (leave - enter) * std::sqrt(square) : 0;
}

/// Light scattered once along the ray from `o` along +y, by the midpoint rule: the steps follow the
/// angle at the lamp, so that a near one is no peak.
double single(const LampParams& lamp, const Double3& o, double sigma, double albedo, double g) {
    const Double3 at{double(lamp.at[0]), double(lamp.at[1]), double(lamp.at[2])};
    const double dx = o[0] - at[0], dz = o[2] - at[2];
    const double height = std::fmax(std::sqrt(dx * dx + dz * dz), 1e-2);
    const double from = std::atan2(0 - at[1], height), to = std::atan2(kEdge - at[1], height);
    const int n = 40000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double angle = from + (to - from) * (i + 0.5) / n;
        const double y = at[1] + height * std::tan(angle);
        const double step = height / std::pow(std::cos(angle), 2) * (to - from) / n;
        const Double3 x{o[0], y, o[2]};
        const double square = dx * dx + dz * dz + (y - at[1]) * (y - at[1]);
        const double d = std::sqrt(square);
        // Light travels along x - at and leaves along -y.
        const double turn = -(y - at[1]) / d;
        const double axis = (dx * double(lamp.axis[0]) + (y - at[1]) * double(lamp.axis[1]) +
                             dz * double(lamp.axis[2])) /
                            d;
        sum += step * sigma * albedo * std::exp(-sigma * (y + within(x, at))) * hg(g, turn) *
               double(lamp.light[0]) * shape(lamp, axis) /
               std::fmax(square, double(lamp.least_square));
    }
    return sum;
}

Mean once_scattered(Rig& rig, const Double3& o, unsigned samples, std::uint64_t seed) {
    PathInput in = path_input(
        rig, make_flat_view({float(o[0]), float(o[1]), float(o[2])}, {0, 1, 0}, 1e-3f, 4, 4), seed);
    in.rules.max_depth = 1;
    in.jitter = false;
    // Pixels of a millimetre: one ray, for all that is compared here.
    return film_average(trace_film(in, samples));
}

TEST_CASE("light of lamps scattered once is the integral along the ray") {
    struct Row {
        const char* name;
        LampParams lamp;
    };
    const Row rows[] = {
        {"lamp inside", point({2.7, 1.9, 2.2}, 3)},
        {"lamp in a cell's corner", point({2, 2, 1.5}, 3)},
        {"lamp a hand from the ray", point({2.05, 1.9, 2}, 3)},
        {"lamp on the ray, with a radius", point({2, 2.2, 2}, 3, 0.25)},
        {"lamp outside", point({6, 3, -1}, 100)},
        {"lamp behind the camera", point({2.1, -3, 2.3}, 100)},
        {"spot from outside", spot({2, 2.5, 7}, {0.1, -0.1, -1}, 0.9, 0.99, 100)},
        {"spot inside", spot({1, 2, 2}, {1, 0.2, 0}, 0.5, 0.8, 3)},
    };
    for (const Row& row : rows)
        for (double sigma : {0.2, 3.0}) {
            Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, sigma);
            set_albedo(rig, {0.8f, 0.8f, 0.8f});
            rig.medium.optics[0].phase = {kPhaseHg, 0.5f, 0, 1};
            set_majorants(rig, 2);
            rig.lighting.lamps = {row.lamp};
            const Double3 o{2, -1, 2};
            // The camera stands outside; its ray enters at y = 0.
            const double exact = single(row.lamp, {o[0], 0, o[2]}, sigma, 0.8, 0.5);
            check_mean(std::string(row.name) + ", extinction " + std::to_string(sigma), exact,
                       [&](int more, std::uint64_t seed) {
                           return once_scattered(rig, o, 60000u * unsigned(more), seed);
                       });
        }
}

TEST_CASE("one of several lamps a vertex: their light adds up") {
    Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, 1);
    set_majorants(rig, 2);
    rig.lighting.lamps = {point({2.7, 1.9, 2.2}, 3), point({6, 3, -1}, 50),
                          spot({2, 2.5, 7}, {0.1, -0.1, -1}, 0.9, 0.99, 70)};
    double exact = 0;
    for (const LampParams& lamp : rig.lighting.lamps) exact += single(lamp, {2, 0, 2}, 1, 1, 0);
    check_mean("three lamps", exact, [&](int more, std::uint64_t seed) {
        return once_scattered(rig, {2, -1, 2}, 60000u * unsigned(more), seed);
    });
}

/// Light that leaves a lamp inside the box without a turn.
double direct_escape(const LampParams& lamp, double sigma) {
    const Double3 at{double(lamp.at[0]), double(lamp.at[1]), double(lamp.at[2])};
    const int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) {
            const double mu = -1 + 2 * (i + 0.5) / n, phi = kPiD * (j + 0.5) / n;
            const double s = std::sqrt(1 - mu * mu);
            const Double3 d{s * std::cos(phi), s * std::sin(phi), mu};
            const double axis = d[0] * double(lamp.axis[0]) + d[1] * double(lamp.axis[1]) +
                                d[2] * double(lamp.axis[2]);
            sum += shape(lamp, axis) * std::exp(-sigma * within(at, at + 20.0 * d));
        }
    return sum * double(lamp.light[0]) * 4 * kPiD / (2.0 * n * n);
}

/// All light that a lamp gives.
double power(const LampParams& lamp) {
    const int n = 100000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += shape(lamp, -1 + 2 * (i + 0.5) / n);
    return sum * double(lamp.light[0]) * 4 * kPiD / n;
}

/// The share of a lamp's light that its radius takes away: what within it would be scattered more.
double missing(double sigma, double radius) {
    const int n = 1000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double u = (i + 0.5) / n;
        sum += sigma * std::exp(-sigma * radius * u) * (1 - u * u) * radius / n;
    }
    return sum;
}

TEST_CASE("S79: a white box sends out all light of a lamp in it") {
    // A radius makes errors small.
    constexpr double kRadius = 0.25;
    LampParams lamps[] = {point({1.3, 2.2, 2.9}, 2, kRadius),
                          spot({1.3, 2.2, 2.9}, {1, 0.5, -0.3}, 0.6, 0.9, 5)};
    lamps[1].least_square = lamps[0].least_square;
    for (const LampParams& lamp : lamps)
        for (double sigma : {0.5, 3.0})
            for (float g : {0.0f, 0.6f}) {
                Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, sigma);
                rig.medium.optics[0].phase = {kPhaseHg, g, 0, 1};
                set_majorants(rig, 2);
                rig.lighting.lamps = {lamp};
                const double exact =
                    power(lamp) * (1 - missing(sigma, kRadius)) - direct_escape(lamp, sigma);
                const std::string name = std::string(lamp.edge < -1 ? "point" : "spot") +
                                         " in a white box, extinction " + std::to_string(sigma) +
                                         ", g " + std::to_string(g);
                check_mean(name, exact, [&](int more, std::uint64_t seed) {
                    Mean sum;
                    for (int face = 0; face < 6; ++face) {
                        const std::size_t axis = std::size_t(face / 2);
                        std::array<float, 3> centre{2, 2, 2}, inward{};
                        centre[axis] = face % 2 == 0 ? 0.0f : 4.0f;
                        inward[axis] = face % 2 == 0 ? 1.0f : -1.0f;
                        const Mean m = film_average(
                            trace_film(path_input(rig, make_flux_view(centre, inward, 4),
                                                  seed + 7919u * unsigned(face)),
                                       120000u * unsigned(more)));
                        sum.value += m.value * kEdge * kEdge;
                        sum.error += m.error * m.error * kEdge * kEdge * kEdge * kEdge;
                    }
                    sum.error = std::sqrt(sum.error);
                    return sum;
                });
            }
}

TEST_CASE("a parallel light is a second sun") {
    Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, 1);
    set_majorants(rig, 2);
    set_ground(rig, -1, 0.5);
    const CameraParams eye = make_view({2, -6, 3}, {0, 0.96f, -0.28f}, 6, 6);
    LampParams lamp = point({0.6, 0, 0.8}, 2);
    lamp.parallel = 1;
    Rig sunny = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, 1);
    set_majorants(sunny, 2);
    set_ground(sunny, -1, 0.5);
    shine(sunny, {0.6f, 0, 0.8f}, 2);
    rig.lighting.lamps = {lamp};
    const Mean by_sun = film_average(trace_film(path_input(sunny, eye, 99), 30000));
    CHECK(by_sun.error < 0.01 * by_sun.value);
    check_mean("a parallel light less the sun", 0, [&](int more, std::uint64_t seed) {
        const Mean own =
            film_average(trace_film(path_input(rig, eye, seed), 9000u * unsigned(more)));
        return Mean{own.value - by_sun.value,
                    std::sqrt(own.error * own.error + by_sun.error * by_sun.error)};
    });
}

TEST_CASE("the bare ground under a lamp has its closed form") {
    Rig rig = make_rig({2, 2, 2}, {2, 2, 2}, 0);
    set_majorants(rig, 1);
    set_ground(rig, -1, 0.3);
    rig.lighting.lamps = {point({4, 1, 2}, 10)};
    const Film film =
        trace_film(path_input(rig, make_flat_view({1, 1, 9}, {0, 0, -1}, 1e-3f, 1, 1), 1), 16);
    // Three metres up and three aside: cosine 1/sqrt(2), distance^2 18.
    const double exact = 0.3 / kPiD * 10 / 18 / std::sqrt(2.0);
    CHECK(film_mean(film, 0, 0, 0) == doctest::Approx(exact).epsilon(1e-5));
    // In a black box between them the light falls by Beer's law, and what is seen again.
    Rig dark = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, 0.5);
    set_albedo(dark, {0, 0, 0});
    set_majorants(dark, 1);
    set_ground(dark, 0, 1);
    dark.lighting.lamps = {point({2, 2, 2}, 10)};
    check_mean(
        "a lamp in a black box on the ground", 10.0 / 4 / kPiD * std::exp(-0.5 * 2 - 0.5 * 4),
        [&](int more, std::uint64_t seed) {
            const CameraParams eye = make_flat_view({2, 2, 8}, {0, 0, -1}, 1e-3f, 4, 4);
            return film_average(trace_film(path_input(dark, eye, seed), 2000u * unsigned(more)));
        });
}

TEST_CASE("lamps: the same bits for all threads and widths") {
    Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, 1);
    set_majorants(rig, 1);
    set_ground(rig, -1, 0.5);
    rig.lighting.lamps = {point({2.7, 1.9, 2.2}, 3), point({6, 3, -1}, 50),
                          spot({2, 2.5, 7}, {0.1, -0.1, -1}, 0.9, 0.99, 70)};
    const CameraParams eye = make_view({2, -6, 3}, {0, 0.96f, -0.28f}, 9, 7);
    rig.kernels = kernel_table("scalar");
    REQUIRE(rig.kernels != nullptr);
    const Film first = trace_film(path_input(rig, eye, 5), 24);
    for (int i = 0; kernel_table_at(i) != nullptr; ++i)
        for (int threads : {1, 2}) {
            rig.kernels = kernel_table_at(i);
            rig.threads = threads;
            const Film film = trace_film(path_input(rig, eye, 5), 24);
            for (std::size_t v = 0; v < film.sum.size(); ++v) REQUIRE(film.sum[v] == first.sum[v]);
        }
}

}  // namespace
