// SPDX-License-Identifier: Apache-2.0
// What Monette and Whitehead's own weighting errs by: a particle's whole depth, weighted by a
// Gaussian of the distance between its centre and the nearest point of a segment.
// in: balls, segments -> out: a Markdown table of depths against their exact integrals.
// docs/particles-table.md, "The paper's own weighting"
#pragma once
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "src/base/angles.h"

namespace pileus {

struct WeighedBall {
    double at[3], radius, density;
};

/// From a place along a unit vector without end.
struct WeighedRay {
    double from[3], way[3];
};

/// Depth of one ball by its integral.
inline double exact_depth(const WeighedBall& b, const WeighedRay& r) {
    double along = 0, square = 0;
    for (int a = 0; a < 3; ++a) along += (b.at[a] - r.from[a]) * r.way[a];
    for (int a = 0; a < 3; ++a) {
        const double d = b.at[a] - r.from[a] - along * r.way[a];
        square += d * d / (b.radius * b.radius);
    }
    const double inner = 1 - square;
    if (!(inner > 0)) return 0;
    const double half = std::sqrt(inner), from = std::fmax(-half, -along / b.radius);
    if (from >= half) return 0;
    const auto part = [&](double s) {
        return s * (inner * inner - s * s * (inner * 2 / 3 - s * s / 5));
    };
    return b.density * b.radius * (part(half) - part(from));
}

/// The whole of it by its distance, with the same integral over all distances; `spread` of the
/// Gaussian in radii.
inline double weighed_depth(const WeighedBall& b, const WeighedRay& r, double spread) {
    constexpr double kMass = 32 * kPi64 / 105;
    double along = 0, square = 0;
    for (int a = 0; a < 3; ++a) along += (b.at[a] - r.from[a]) * r.way[a];
    if (along < 0) along = 0;
    for (int a = 0; a < 3; ++a) {
        const double d = b.at[a] - r.from[a] - along * r.way[a];
        square += d * d / (b.radius * b.radius);
    }
    if (square >= 1) return 0;
    const double over = 1 / (2 * spread * spread);
    return b.density * b.radius * kMass * over / kPi64 / (1 - std::exp(-over)) *
           std::exp(-square * over);
}

/// A row for each spread. Depths are scaled to a mean of 1.
inline void weigh(const char* name, const std::vector<WeighedBall>& balls,
                  const std::vector<WeighedRay>& rays) {
    constexpr std::array<double, 3> kSpread = {0.333333333, 0.4, 0.5};
    std::vector<std::array<double, 4>> depth(rays.size());
    double mean = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        for (const WeighedBall& b : balls) {
            depth[i][3] += exact_depth(b, rays[i]);
            for (std::size_t s = 0; s < 3; ++s)
                depth[i][s] += weighed_depth(b, rays[i], kSpread[s]);
        }
        mean += depth[i][3] / double(rays.size());
    }
    for (std::size_t s = 0; s < 3; ++s) {
        double bias = 0, square = 0, light = 0, most = 0;
        for (const auto& own : depth) {
            const double error = (own[s] - own[3]) / mean;
            const double seen = std::exp(-own[s] / mean) - std::exp(-own[3] / mean);
            bias += error / double(rays.size());
            square += error * error / double(rays.size());
            light += seen * seen / double(rays.size());
            most = std::fmax(most, std::fabs(error));
        }
        fmt::print("| {} | {:.2f} | {:+.4f} | {:.4f} | {:.4f} | {:.4f} |\n", name, kSpread[s], bias,
                   std::sqrt(square), most, std::sqrt(light));
    }
}

}  // namespace pileus
