// SPDX-License-Identifier: Apache-2.0
// See cloud.h. Stacks the plates of a lens; kernels_cpu/procedural/cloud_lens.h fills the grid.
// in: a place -> out: nx*ny*nz floats in [0, 1]. docs/generators.md, "Lenses"
#include <algorithm>
#include <cmath>

#include "platform/threads.h"
#include "src/world/density/cloud.h"
#include "src/world/density/draws.h"

namespace pileus {
namespace {

// Radius along the wind over that across; how much longer lenses are downwind.
constexpr double kAlong = 0.62, kLee = 1.5;
constexpr double kStriae = 0.12;  // bends of thin layers over a rim's radius

/// Plates from below upwards, each over the one before, smaller and downwind of it by chance.
void stack_plates(const CloudSettings& s, CloudLensParams& k) {
    Draws draws(std::uint64_t(s.seed), kCloudBallStream);
    const float h = float(s.height_m), r = float(s.radius_m);
    k.count = std::int32_t(std::min(s.plates, std::int64_t(kMaxCloudPlates)));
    // Shares of the height by chance; together they fill it.
    float shares[kMaxCloudPlates], sum = 0;
    for (int i = 0; i < k.count; ++i) sum += shares[i] = draws.between(0.6f, 1.4f);
    float floor = 0;
    for (int i = 0; i < k.count; ++i) {
        const float thick = shares[i] / sum * h;
        const float t = (floor + 0.5f * thick) / h;
        CloudPlate& p = k.plates[i];
        // Lenses bulge upwards; the next one's underside sinks into their tops.
        p.under = thick * draws.between(0.14f, 0.26f);
        p.over = thick * (i + 1 < k.count ? draws.between(0.8f, 1.0f) : 0.75f);
        p.rim = floor + p.under;
        const float size = i == 0 ? 0.85f : (1.0f - 0.3f * t) * draws.between(0.72f, 1.0f);
        p.across = r * size;
        p.along = float(kAlong) * r * size * draws.between(0.9f, 1.1f);
        p.x = float(s.shear) * p.rim + 0.12f * r * draws.between(-1.0f, 1.0f);
        p.y = 0.12f * r * draws.between(-1.0f, 1.0f);
        floor += thick;
    }
}

}  // namespace

std::array<Double3, 2> lens_extent(const CloudSettings& s) {
    // Radii, middles by chance, and what bends of the rim add.
    const double r = s.radius_m / s.height_m;
    const double bend = 1 / std::sqrt(std::max(0.5, 1 - 1.05 * s.outline - 0.75 * kStriae));
    const AnvilPlace wind = anvil_place(s);
    const double x = double(wind.wind_x), y = double(wind.wind_y);
    const double down = 1.1 * kAlong * kLee * bend * r + 0.12 * r + s.shear;
    const double up = 1.1 * kAlong * bend * r + 0.12 * r, side = (bend + 0.12) * r;
    const double side_x = side * std::max(y, -y), side_y = side * std::max(x, -x);
    return {
        Double3{std::min(down * x, -up * x) - side_x, std::min(down * y, -up * y) - side_y, -0.05},
        Double3{std::max(down * x, -up * x) + side_x, std::max(down * y, -up * y) + side_y, 1.1}};
}

Status make_lens(const CloudInGrid& place, const CloudMaking& with, Volume& volume) {
    const CloudSettings& cloud = place.cloud;
    CloudLensParams k{};
    stack_plates(cloud, k);
    float voxel = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const int axis = int(a);
        const double edge = place.bounds_m[1][axis] - place.bounds_m[0][axis];
        k.size[a] = with.size[a];
        k.cell[a] = float(edge / with.size[a]);
        k.corner[a] = float(place.bounds_m[0][axis] - place.foot_m[axis]) + 0.5f * k.cell[a];
        voxel = std::max(voxel, k.cell[a]);
    }
    const AnvilPlace wind = anvil_place(cloud);
    k.wind_x = wind.wind_x, k.wind_y = wind.wind_y;
    k.seed = make_key(std::uint64_t(cloud.seed), kCloudLumpStream, 2).k0;
    const float h = float(cloud.height_m);
    k.lee = float(kLee), k.striae = float(kStriae), k.per_stria = 14.0f / h;
    k.outline = float(cloud.outline), k.per_outline = float(1 / (0.8 * cloud.radius_m));
    k.edge = std::max(0.02f * h, 1.4f * k.cell[2]);
    const CloudLensBuffers b{volume.density.data()};
    parallel_for(with.threads, std::int64_t(k.size[1]) * k.size[2], [&](std::int64_t row, int) {
        with.kernels.fill_cloud_lens(k, b, std::uint32_t(row), std::uint32_t(row) + 1);
    });
    return Status::ok();
}

}  // namespace pileus
