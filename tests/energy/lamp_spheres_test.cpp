// SPDX-License-Identifier: Apache-2.0
// Lamps that are spheres by paths: energy, light scattered once, closed forms, the same bits.
// in: spheres made by hand in and beside a box -> out: pass or fail.
// docs/lights.md, "Spheres". Statistics by check_mean.
#include <cmath>

#include "tests/support/path_harness.h"

namespace {

using namespace path_test;

constexpr double kPiD = 3.14159265358979323846;
constexpr double kEdge = 4;  // of the box, m

/// All around, irradiance `intensity` / d^2.
LampParams sphere(Double3 at, double radius, double intensity) {
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
    lamp.radius = float(radius);
    lamp.places = 8;
    return lamp;
}

LampParams sphere_spot(Double3 at, double radius, double intensity) {
    LampParams lamp = sphere(at, radius, intensity);
    lamp.axis[0] = 0.6f, lamp.axis[1] = 0, lamp.axis[2] = -0.8f;
    lamp.edge = 0.5f;
    lamp.slope = 1 / (0.8f - 0.5f);
    return lamp;
}

double shape(const LampParams& lamp, const Double3& d) {
    double cosine = 0;
    for (int a = 0; a < 3; ++a) cosine += d[a] * double(lamp.axis[std::size_t(a)]);
    const double x =
        std::fmin(std::fmax((cosine - double(lamp.edge)) * double(lamp.slope), 0.0), 1.0);
    return x * x * (3 - 2 * x);
}

double norm(const Double3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Metres of the ray from `a` along the unit vector `d`, `most` long, within the box.
double within(const Double3& a, const Double3& d, double most) {
    double enter = 0, leave = most;
    for (int i = 0; i < 3; ++i) {
        if (std::fabs(d[i]) < 1e-12) continue;
        const double x = (0 - a[i]) / d[i], y = (kEdge - a[i]) / d[i];
        enter = std::fmax(enter, std::fmin(x, y));
        leave = std::fmin(leave, std::fmax(x, y));
    }
    return std::fmax(leave - enter, 0.0);
}

/// Two unit vectors across `d`.
void frame(const Double3& d, Double3& s, Double3& t) {
    const Double3 up = std::fabs(d[2]) < 0.9 ? Double3{0, 0, 1} : Double3{1, 0, 0};
    s = Double3{d[1] * up[2] - d[2] * up[1], d[2] * up[0] - d[0] * up[2],
                d[0] * up[1] - d[1] * up[0]};
    s = s / norm(s);
    t = Double3{d[1] * s[2] - d[2] * s[1], d[2] * s[0] - d[0] * s[2], d[0] * s[1] - d[1] * s[0]};
}

/// Light scattered once along the ray from (2, 0, 2) along +y, isotropic: a sum over the ray and
/// the directions in which its places see the sphere.
double single(const LampParams& lamp, double sigma) {
    const Double3 at{double(lamp.at[0]), double(lamp.at[1]), double(lamp.at[2])};
    const double radius = double(lamp.radius);
    const double radiance = double(lamp.light[0]) / (kPiD * radius * radius);
    const int n = 2000, rings = 24, turns = 24;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double y = kEdge * (i + 0.5) / n;
        const Double3 x{2, y, 2};
        const double d = norm(at - x);
        if (d <= radius) continue;
        const Double3 way = (at - x) / d;
        Double3 s, t;
        frame(way, s, t);
        const double versine = 1 - std::sqrt(1 - radius * radius / (d * d));
        double light = 0;
        for (int a = 0; a < rings; ++a)
            for (int b = 0; b < turns; ++b) {
                const double turn = versine * (a + 0.5) / rings, phi = 2 * kPiD * (b + 0.5) / turns;
                const double sine = std::sqrt(turn * (2 - turn));
                const Double3 to =
                    (1 - turn) * way + sine * (std::cos(phi) * s + std::sin(phi) * t);
                const double far = d * (1 - turn) -
                                   std::sqrt(std::fmax(radius * radius - d * d * sine * sine, 0.0));
                light += shape(lamp, -to) * std::exp(-sigma * within(x, to, far));
            }
        light *= radiance * 2 * kPiD * versine / (rings * turns);
        sum += kEdge / n * sigma * std::exp(-sigma * y) * light / (4 * kPiD);
    }
    return sum;
}

TEST_CASE("light of spheres scattered once is the integral over ray and sphere") {
    struct Row {
        const char* name;
        LampParams lamp;
    };
    const Row rows[] = {
        {"sphere inside", sphere({2.9, 1.9, 2.2}, 0.5, 3)},
        {"sphere across the ray", sphere({2.2, 2, 2}, 0.6, 3)},
        {"sphere outside", sphere({7, 3, -1}, 2, 100)},
        {"sphere half in the box", sphere({2, 2.5, 4.1}, 0.7, 5)},
        {"spot inside", sphere_spot({1.2, 2, 2.6}, 0.4, 5)},
    };
    for (const Row& row : rows)
        for (double sigma : {0.2, 2.0}) {
            Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, sigma);
            set_majorants(rig, 2);
            rig.lighting.lamps = {row.lamp};
            const double exact = single(row.lamp, sigma);
            check_mean(std::string(row.name) + ", extinction " + std::to_string(sigma), exact,
                       [&](int more, std::uint64_t seed) {
                           PathInput in = path_input(
                               rig, make_flat_view({2, -1, 2}, {0, 1, 0}, 1e-3f, 4, 4), seed);
                           in.rules.max_depth = 1;
                           in.jitter = false;
                           return film_average(trace_film(in, 60000u * unsigned(more)));
                       });
        }
}

/// Light that leaves the box without a turn: over directions, and places on the disc across each.
double direct_escape(const LampParams& lamp, double sigma) {
    const Double3 at{double(lamp.at[0]), double(lamp.at[1]), double(lamp.at[2])};
    const double radius = double(lamp.radius);
    const int n = 100, rings = 6, turns = 8;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) {
            const double mu = -1 + 2 * (i + 0.5) / n, phi = kPiD * (j + 0.5) / n;
            const double sine = std::sqrt(1 - mu * mu);
            const Double3 d{sine * std::cos(phi), sine * std::sin(phi), mu};
            const double falloff = shape(lamp, d);
            if (falloff == 0) continue;
            Double3 s, t;
            frame(d, s, t);
            for (int a = 0; a < rings; ++a)
                for (int b = 0; b < turns; ++b) {
                    const double r = std::sqrt((a + 0.5) / rings), p = 2 * kPiD * (b + 0.5) / turns;
                    const Double3 from = at + radius * (r * (std::cos(p) * s + std::sin(p) * t) +
                                                        std::sqrt(1 - r * r) * d);
                    sum += falloff * std::exp(-sigma * within(from, d, 20)) / (rings * turns);
                }
        }
    return sum * double(lamp.light[0]) * 4 * kPiD / (2.0 * n * n);
}

/// All light that a lamp gives: its radius takes none.
double power(const LampParams& lamp) {
    const int n = 100000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double c = -1 + 2 * (i + 0.5) / n;
        const double x =
            std::fmin(std::fmax((c - double(lamp.edge)) * double(lamp.slope), 0.0), 1.0);
        sum += x * x * (3 - 2 * x);
    }
    return sum * double(lamp.light[0]) * 4 * kPiD / n;
}

TEST_CASE("S79: a white box sends out all light of a sphere in it") {
    for (const LampParams& lamp :
         {sphere({1.3, 2.2, 2.5}, 0.8, 2), sphere_spot({1.3, 2.2, 2.5}, 0.8, 5)})
        for (double sigma : {0.5, 3.0}) {
            Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, sigma);
            rig.medium.optics[0].phase = {kPhaseHg, 0.5f, 0, 1};
            set_majorants(rig, 2);
            rig.lighting.lamps = {lamp};
            const double exact = power(lamp) - direct_escape(lamp, sigma);
            const std::string name = std::string(lamp.edge < -1 ? "sphere" : "spot") +
                                     " in a white box, extinction " + std::to_string(sigma);
            check_mean(name, exact, [&](int more, std::uint64_t seed) {
                Mean sum;
                for (int face = 0; face < 6; ++face) {
                    const std::size_t axis = std::size_t(face / 2);
                    std::array<float, 3> centre{2, 2, 2}, inward{};
                    centre[axis] = face % 2 == 0 ? 0.0f : 4.0f;
                    inward[axis] = face % 2 == 0 ? 1.0f : -1.0f;
                    const Mean m =
                        film_average(trace_film(path_input(rig, make_flux_view(centre, inward, 4),
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

TEST_CASE("the bare ground under a sphere has the irradiance of a point") {
    Rig rig = make_rig({2, 2, 2}, {2, 2, 2}, 0);
    set_majorants(rig, 1);
    set_ground(rig, -1, 0.3);
    for (double radius : {0.01, 1.0, 2.5}) {
        rig.lighting.lamps = {sphere({4, 1, 2}, radius, 10)};
        // Three metres up and three aside, all of it above the horizon: as far as that holds, the
        // irradiance of a sphere is that of its middle.
        const double exact = 0.3 / kPiD * 10 / 18 / std::sqrt(2.0);
        check_mean("radius " + std::to_string(radius), exact, [&](int more, std::uint64_t seed) {
            const CameraParams eye = make_flat_view({1, 1, 9}, {0, 0, -1}, 1e-3f, 4, 4);
            return film_average(trace_film(path_input(rig, eye, seed), 4000u * unsigned(more)));
        });
    }
}

TEST_CASE("spheres: the same bits for all threads and widths") {
    Rig rig = make_rig({4, 4, 4}, {kEdge, kEdge, kEdge}, 1);
    set_majorants(rig, 1);
    set_ground(rig, -1, 0.5);
    rig.lighting.lamps = {sphere({2.7, 1.9, 2.2}, 0.4, 3), sphere({6, 3, 1}, 1.5, 50),
                          sphere_spot({2, 2.5, 7}, 0.6, 70)};
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
