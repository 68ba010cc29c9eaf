// SPDX-License-Identifier: Apache-2.0
// See cloud.h. Where it rains below a cloud and how much; kernels_cpu/procedural/cloud_rain.h fills
// the grid.
// in: a place, shafts of a heap -> out: nx*ny*nz floats in [0, 1]. docs/generators.md, "Rain"
#include <algorithm>

#include "platform/threads.h"
#include "src/base/powers.h"
#include "src/scene/media/cloud_types.h"
#include "src/world/density/cloud.h"
#include "src/world/density/draws.h"

namespace pileus {
namespace {

/// Rain of 1, mm/h.
constexpr double kFullRain = 50;
/// Extinction of 1 mm/h in 1/m, and its power: drops N = 8e6 /m^4 e^(-4100/m R^-0.21 D) of twice
/// their cross-section, pi 8e6 / 4100^3 (Marshall and Palmer 1948).
constexpr double kRainExtinction = 3.65e-4, kRainPower = 0.63;
/// Metres in which air of 60 % relative humidity at 20 degrees takes up rain of 50 mm/h; that of
/// others goes by the root of the extinction (Kessler 1969).
constexpr double kRainLost = 5600;
constexpr double kRainFalls = 6;    // m/s
constexpr double kMaxLean = 0.5;    // of streaks, over the height fallen
constexpr double kMinDepth = 0.02;  // of a shaft, over the cloud's height

/// Share of a lean that keeps shafts within the box.
double lean_that_fits(const CloudInGrid& place, const CloudRainParams& k) {
    double share = 1;
    for (std::int32_t i = 0; i < k.count; ++i)
        for (int a = 0; a < 2; ++a) {
            // Streaks trail against the lean.
            const double moved = -double(a == 0 ? k.lean_x : k.lean_y) * double(k.depth);
            const double at = place.foot_m[a] + double(a == 0 ? k.shafts[i].x : k.shafts[i].y);
            const double r = double(k.shafts[i].r);
            const double room =
                moved > 0 ? place.bounds_m[1][a] - r - at : at - r - place.bounds_m[0][a];
            if (moved != 0) share = std::min(share, room / std::max(moved, -moved));
        }
    return std::max(share, 0.0);
}

CloudRainParams rain_params(const CloudInGrid& place, const CloudHeap& heap,
                            const std::array<int, 3>& size) {
    const CloudSettings& cloud = place.cloud;
    const CloudType& type = cloud_type(cloud.type);
    const CloudLife life = cloud_life(cloud);
    const double h = cloud.height_m;
    CloudRainParams k{};
    for (std::size_t a = 0; a < 3; ++a) {
        const int axis = int(a);
        const double edge = place.bounds_m[1][axis] - place.bounds_m[0][axis];
        k.size[a] = size[a];
        k.cell[a] = float(edge / size[a]);
        k.corner[a] = float(place.bounds_m[0][axis] - place.foot_m[axis]) + 0.5f * k.cell[a];
    }
    k.top = float(kMinDepth * h);
    k.depth = float(std::max(place.foot_m.z - place.bounds_m[0].z, kMinDepth * h));
    const float high = (k.top - k.corner[2]) / k.cell[2] + 1;
    k.layers = std::int32_t(std::min(std::max(high, 0.0f), float(size[2] - 1)));
    k.strength = float(power_of(cloud.rain, 0.5 * kRainPower) * life.rain);
    k.lost_per_m = float(1 / kRainLost);
    const double of_one =
        type.extinction_per_m > 0 ? type.extinction_per_m : cloud_extinction_per_m(place.full_m);
    k.full = float(kRainExtinction * power_of(kFullRain, kRainPower) / of_one);
    // In the range of the noise, whatever the lifetime.
    k.fallen = float(std::min(kRainFalls * life.rained_s, 1e5 * double(k.depth)));
    k.seed = make_key(std::uint64_t(cloud.seed), kCloudRainStream, 0).k0;
    double width = 0;
    if (type.form == CloudForm::kHeap) {
        k.count = std::int32_t(heap.shafts);
        for (std::size_t i = 0; i < heap.shafts; ++i) {
            const RainShaft& s = heap.shaft[i];
            k.shafts[i] = {s.x * float(h), s.y * float(h), s.r * float(h)};
            width = std::max(width, double(k.shafts[i].r));
        }
        // As params_of bends the heap.
        k.plan = float(cloud.outline * cloud.radius_m);
        k.plan_per_m = float(1 / (0.7 * cloud.radius_m));
        k.plan_seed = make_key(std::uint64_t(cloud.seed), kCloudLumpStream, 0).k0;
        const WindWay wind = wind_at(cloud, 0);
        const double lean = std::min(cloud.shear, kMaxLean);
        k.lean_x = float(lean) * wind.x, k.lean_y = float(lean) * wind.y;
        const float share = float(lean_that_fits(place, k));
        k.lean_x *= share, k.lean_y *= share;
    } else {
        width = 0.5 * cloud.cell_m;
        k.lean_x = 0.3f;
    }
    double length = width;
    for (int o = 0; o < 3; ++o, length *= 0.36) {
        for (int a = 0; a < 2; ++a) {
            const double edge = place.bounds_m[1][a] - place.bounds_m[0][a];
            const int cells = std::max(int(edge / length + 0.5), 1);
            (a == 0 ? k.period_x : k.period_y)[o] = k.count == 0 ? cells : 0;
            (a == 0 ? k.per_x : k.per_y)[o] = float(k.count == 0 ? cells / edge : 1 / length);
        }
        k.per_z[o] = float(1 / std::max(5 * length, 1.5 * double(k.depth)));
    }
    return k;
}

}  // namespace

Status make_rain(const CloudInGrid& place, const CloudHeap& heap, const CloudMaking& with,
                 Volume& volume) {
    const CloudRainParams k = rain_params(place, heap, with.size);
    if (!(k.strength > 0) || k.layers == 0) return Status::ok();
    const CloudRainBuffers b{volume.density.data()};
    parallel_for(with.threads, std::int64_t(k.layers) * k.size[1], [&](std::int64_t row, int) {
        with.kernels.fill_cloud_rain(k, b, std::uint32_t(row), std::uint32_t(row) + 1);
    });
    return Status::ok();
}

}  // namespace pileus
