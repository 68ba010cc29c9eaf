// SPDX-License-Identifier: Apache-2.0
// Radiance of a clear sky by paths through round air, with nothing of the tables that it checks.
// in: coefficients of the air, a channel -> out: a mean and its standard error.
// Delta tracking with local bounds, the sun's light at every scattering.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include "src/world/atmosphere/air.h"

namespace air_test {

constexpr double kPi = 3.14159265358979323846;

struct Way {
    double x = 0, y = 0, z = 0;
    double dot(const Way& o) const { return x * o.x + y * o.y + z * o.z; }
    Way operator*(double s) const { return {x * s, y * s, z * s}; }
    Way operator+(const Way& o) const { return {x + o.x, y + o.y, z + o.z}; }
    double length() const { return std::sqrt(dot(*this)); }
    Way unit() const { return *this * (1 / length()); }
};

/// Towards an elevation and an azimuth from the sun's, degrees.
inline Way towards(double elevation, double azimuth) {
    const double e = elevation * kPi / 180, a = azimuth * kPi / 180;
    return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

struct Estimate {
    double mean = 0, error = 0;
};

class AirReference {
public:
    AirReference(const pileus::Air& air, int channel) : air_(air), c_(channel) {}

    /// From `height_km` along `way`, under a sun of irradiance 1 above the air.
    Estimate radiance(double height_km, const Way& way, const Way& sun, int paths) {
        double sum = 0, square = 0;
        for (int i = 0; i < paths; ++i) {
            const double v = path({0, 0, pileus::kEarthRadiusKm + height_km + 1e-6}, way, sun);
            sum += v;
            square += v * v;
        }
        const double mean = sum / paths;
        return {mean, std::sqrt((square / paths - mean * mean) / paths)};
    }

private:
    double uniform() { return std::generate_canonical<double, 53>(random_); }
    double extinction(double h) const {
        const double high = std::max(h, 0.0), away = std::abs(high - 25);
        return double(air_.rayleigh[c_]) * std::exp(-high / double(pileus::kAirScaleKm)) +
               double(air_.haze_all[c_]) * std::exp(-high / double(pileus::kHazeScaleKm)) +
               double(air_.ozone[c_]) * (away < 15 ? 1 - away / 15 : 0);
    }
    /// Share of the sun's light at a place.
    double sunlight(const Way& at, const Way& sun) const {
        const double r = at.length(), b = at.dot(sun);
        const double ground = pileus::kEarthRadiusKm, top = pileus::kAirTopKm;
        if (b < 0 && b * b - r * r + ground * ground >= 0) return 0;
        const double length = -b + std::sqrt(b * b - r * r + top * top);
        double depth = 0, before = 0;
        constexpr int kSteps = 200;
        for (int i = 0; i < kSteps; ++i) {
            const double end = length * (i + 1.0) * (i + 1.0) / (kSteps * kSteps);
            const double s = 0.5 * (before + end);
            depth += extinction(std::sqrt(r * r + s * s + 2 * s * b) - ground) * (end - before);
            before = end;
        }
        return std::exp(-depth);
    }
    Way turned(const Way& d, double cosine) {
        const Way a = std::abs(d.x) > 0.9 ? Way{0, 1, 0} : Way{1, 0, 0};
        const Way u =
            Way{d.y * a.z - d.z * a.y, d.z * a.x - d.x * a.z, d.x * a.y - d.y * a.x}.unit();
        const Way v{d.y * u.z - d.z * u.y, d.z * u.x - d.x * u.z, d.x * u.y - d.y * u.x};
        const double turn = 2 * kPi * uniform();
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        return (d * cosine + u * (sine * std::cos(turn)) + v * (sine * std::sin(turn))).unit();
    }
    double draw_cosine(double rayleigh, double haze) {
        if (uniform() * (rayleigh + haze) < rayleigh) {
            for (;;) {
                const double cosine = 2 * uniform() - 1;
                if (uniform() * 2 < 1 + cosine * cosine) return cosine;
            }
        }
        const double g = double(air_.haze_g), z = (1 - g * g) / (1 - g + 2 * g * uniform());
        return (1 + g * g - z * z) / (2 * g);
    }
    double path(Way at, Way d, const Way& sun) {
        const double ground = pileus::kEarthRadiusKm, top = pileus::kAirTopKm,
                     g = double(air_.haze_g);
        double weight = 1, light = 0;
        for (int order = 0; order < 60 && weight > 1e-4; ++order) {
            const double r = at.length(), b = at.dot(d);
            const double low = b * b - r * r + ground * ground;
            const bool hits = low > 0 && b < 0;
            const double end =
                hits ? -b - std::sqrt(low) : -b + std::sqrt(b * b - r * r + top * top);
            double t = 0;
            bool met = false;
            while (t < end && !met) {
                // No step leads 4 km down, so that this is a bound.
                const double h = std::sqrt(r * r + t * t + 2 * t * b) - ground;
                double most = extinction(std::max(0.0, h - 4)) + 1e-9;
                if (h > 6) most += extinction(25);
                const double step = -std::log(1 - uniform()) / most;
                t += std::min(step, 4.0);
                if (step >= 4 || t >= end) continue;
                const double there = std::sqrt(r * r + t * t + 2 * t * b) - ground;
                met = uniform() * most < extinction(there);
            }
            if (met) {
                at = at + d * t;
                const double h = at.length() - ground, cosine = d.dot(sun), all = extinction(h);
                const double rayleigh =
                    double(air_.rayleigh[c_]) * std::exp(-h / double(pileus::kAirScaleKm));
                const double haze =
                    double(air_.haze[c_]) * std::exp(-h / double(pileus::kHazeScaleKm));
                const double henyey =
                    (1 - g * g) / (4 * kPi) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
                light += weight * sunlight(at, sun) / all *
                         (rayleigh * 3 / (16 * kPi) * (1 + cosine * cosine) + haze * henyey);
                weight *= (rayleigh + haze) / all;
                d = turned(d, draw_cosine(rayleigh, haze));
            } else if (hits) {
                const Way up = (at + d * end).unit();
                at = up * (ground + 1e-6);
                const double level = up.dot(sun), albedo = double(air_.ground);
                if (level > 0) light += weight * albedo / kPi * level * sunlight(at, sun);
                weight *= albedo;
                d = turned(up, std::sqrt(uniform()));
            } else {
                break;
            }
        }
        return light;
    }

    const pileus::Air& air_;
    int c_;
    std::mt19937_64 random_{1};
};

}  // namespace air_test
