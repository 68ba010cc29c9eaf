// SPDX-License-Identifier: Apache-2.0
// See cloud.h. Lays a heap of balls, or a field of them, on its grid;
// kernels_cpu/procedural/cloud_heap.h fills it. in: places -> out: nx*ny*nz floats in [0, 1].
// docs/generators.md, "A field"
#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels_cpu/procedural/noise.h"
#include "platform/threads.h"
#include "src/scene/media/cloud_types.h"
#include "src/world/density/cloud.h"
#include "src/world/density/draws.h"

namespace pileus {
namespace {

constexpr std::size_t kMaxFieldClouds = 4000;
constexpr int kFieldTries = 40;
constexpr double kMammaDepth = 0.06, kShelfDepth = 0.04;  // over the height

CloudParams params_of(const CloudInGrid& place, const CloudHeap& heap,
                      const std::array<int, 3>& size, Buffer<CloudBall>& balls) {
    const CloudSettings cloud = cloud_at_age(place.cloud);
    const float h = float(cloud.height_m);
    for (std::size_t i = 0; i < heap.count; ++i) {
        CloudBall b = heap.balls[i];
        b.x *= h, b.y *= h, b.z *= h, b.r *= h;
        // A ball that has not come out of the others yet has a radius below 0.
        b.join = 0.05f * (b.spare > 0 ? b.spare * h : b.r), b.unjoin = 0.25f / b.join;
        balls[i] = b;
    }
    CloudParams k{};
    k.balls = balls.data(), k.count = std::int32_t(heap.count);
    for (std::size_t a = 0; a < 3; ++a) {
        const int axis = int(a);
        const double edge = place.bounds_m[1][axis] - place.bounds_m[0][axis];
        const double cell = edge / double(size[a]);
        k.size[a] = size[a];
        // Of the cells that it may reach the outermost ones of the grid stay empty.
        const double low = place.foot_m[axis] + heap.extent[0][axis] * cloud.height_m;
        const double high = place.foot_m[axis] + heap.extent[1][axis] * cloud.height_m;
        const double from = (low - place.bounds_m[0][axis]) / cell;
        const double to = (high - place.bounds_m[0][axis]) / cell + 1;
        k.begin[a] = int(std::min(std::max(from, 1.0), size[a] - 1.0));
        k.end[a] = int(std::max(std::min(to, size[a] - 1.0), double(k.begin[a])));
        k.cell[a] = float(cell);
        k.corner[a] = float(place.bounds_m[0][axis] + 0.5 * cell - place.foot_m[axis]);
        k.voxel = std::max(k.voxel, k.cell[a]);
    }
    k.rows_y = (k.end[1] - k.begin[1] + kCloudBlock - 1) / kCloudBlock;
    k.seed = make_key(std::uint64_t(cloud.seed), kCloudLumpStream, 0).k0;
    k.height = h;
    k.bend = 0.16f * 0.20f * h, k.bend_per_m = 1 / (0.20f * h);
    k.plan = float(cloud.outline * cloud.radius_m),
    k.plan_per_m = float(1 / (0.7 * cloud.radius_m));
    for (std::size_t i = 0; i < heap.count; ++i) k.join = std::max(k.join, balls[i].join);
    k.vigour_reach = 0.03f * h;
    k.lump = (place.cloud.anvil > 0 ? 0.11f : float(cloud_type(place.cloud.type).lump)) * h;
    for (float s = k.lump; s > 1.8f * k.voxel && k.octaves < 16; s *= 0.5f) ++k.octaves;
    k.erosion = float(cloud.erosion);
    const CloudLife life = cloud_life(place.cloud);
    k.lift = life.lift * h, k.water = life.water;
    k.age = float(cloud.age), k.dilution = float(cloud.dilution);
    k.entrainment = float(0.001 * cloud.entrainment_per_km);
    // Of a cloud of usual size 30 and 6 m, but not finer than the grid.
    k.soft = std::max(std::min(30.0f, 0.05f * h), 1.4f * k.voxel);
    k.crisp = std::max(std::min(6.0f, 0.01f * h), 1.4f * k.voxel);
    double full = full_height_m(place.full_m);
    if (place.cloud.anvil > 0) {
        // Of a cloud of 10 km: water rains out above 2.5 km.
        k.saturation = 4 / h;
        full /= 1 + full * double(k.saturation);
        const AnvilPlace anvil = anvil_place(cloud);
        k.anvil_radius = float(cloud.anvil) * h;
        k.anvil_sunk = life.anvil_sunk * h;
        k.anvil_top = anvil.top * h, k.anvil_depth = anvil.depth * h;
        k.anvil_x = anvil.x * h, k.anvil_y = anvil.y * h;
        k.wind_x = anvil.wind_x, k.wind_y = anvil.wind_y;
        k.mamma = float(kMammaDepth * cloud.mamma) * h;
    }
    if (cloud.shelf > 0) {
        // The lip is where the air near the ground blows to.
        const WindWay wind = wind_at(cloud, 0);
        k.shelf = float(kShelfDepth * cloud.shelf) * h, k.foot = float(cloud.radius_m);
        k.shelf_x = wind.x, k.shelf_y = wind.y;
    }
    k.per_full = float(1 / full);
    return k;
}

/// A cloud of a field that lives: one after the other stands at its place, large ones longer, each
/// with a time of its own.
void live_in_turn(const CloudSettings& field, std::size_t number, double radius, CloudSettings& c) {
    const std::uint32_t key = make_key(std::uint64_t(field.seed), kCloudLifeStream, 1 + number).k0;
    const double first = double(key >> 8) * 0x1p-24;
    c.lifetime_s = field.lifetime_s * std::max(0.35, std::sqrt(radius / field.radius_m));
    const double lives = field.age_s / c.lifetime_s + first, whole = std::floor(lives);
    c.age_s = (lives - whole) * c.lifetime_s;
    c.seed += std::int64_t(whole) * 97;
}

/// A cloud of a field.
struct FieldCloud {
    double x, y, radius;
};

/// Places of clouds, the largest first, gathered by slow noise, none within another.
std::vector<FieldCloud> strew(const CloudInGrid& place, Draws& draws, std::uint32_t seed) {
    const auto& box = place.bounds_m;
    const double width = box[1].x - box[0].x, depth = box[1].y - box[0].y;
    const double largest = place.cloud.radius_m, smallest = std::min(60.0, 0.25 * largest);
    std::vector<double> sizes;
    double sum = 0;
    const double asked = place.cloud.cover * width * depth / 1.5;
    while (sum < asked && sizes.size() < kMaxFieldClouds) {
        const double u = double(draws.between(0.0f, 1.0f));
        sizes.push_back(1 / (u / largest + (1 - u) / smallest));
        sum += sizes.back() * sizes.back();
    }
    std::sort(sizes.begin(), sizes.end(), [](double a, double b) { return a > b; });
    std::vector<FieldCloud> out;
    for (const double r : sizes) {
        const double rim = 1.7 * r;
        if (2 * rim >= std::min(width, depth)) continue;
        for (int k = 0; k < kFieldTries; ++k) {
            const double x = rim + (width - 2 * rim) * double(draws.between(0.0f, 1.0f));
            const double y = rim + (depth - 2 * rim) * double(draws.between(0.0f, 1.0f));
            const float n =
                0.5f + 0.9f * gradient_noise<float>(float(x / 2500), float(y / 2500), 0.5f, seed);
            if (draws.between(0.0f, 1.0f) > 2 * n * std::fabs(n)) continue;
            bool free = true;
            for (const FieldCloud& other : out) {
                const double dx = x - other.x, dy = y - other.y, least = 0.8 * (r + other.radius);
                free = free && dx * dx + dy * dy >= least * least;
            }
            if (!free) continue;
            out.push_back({x, y, r});
            break;
        }
    }
    return out;
}

}  // namespace

Status make_heap(const CloudInGrid& place, const CloudHeap& heap, const CloudMaking& with,
                 Volume& volume) {
    if (heap.count == 0) return Status::ok();  // not yet there, or gone
    Buffer<CloudBall> balls;
    PILEUS_TRY(balls.resize(std::max(heap.count, std::size_t(1)), "balls of a cloud"));
    CloudParams k = params_of(place, heap, with.size, balls);
    k.all_balls = with.all_balls ? 1 : 0;
    const std::int64_t layers = (k.end[2] - k.begin[2] + kCloudBlock - 1) / kCloudBlock;
    const int workers = with.threads > 0 ? with.threads : hardware_threads();
    Buffer<std::int32_t> scratch;
    PILEUS_TRY(scratch.resize(std::uint64_t(workers) * kCloudScratch, "cloud scratch"));
    parallel_for(workers, k.rows_y * layers, [&](std::int64_t piece, int thread) {
        const CloudBuffers b{volume.density.data(),
                             scratch.data() + std::size_t(thread) * kCloudScratch};
        with.kernels.fill_cloud(k, b, std::uint32_t(piece), std::uint32_t(piece) + 1);
    });
    return Status::ok();
}

Status make_field(const CloudInGrid& place, const CloudMaking& with, Volume& volume) {
    Draws draws(std::uint64_t(place.cloud.seed), kCloudFieldStream);
    const std::uint32_t seed = make_key(std::uint64_t(place.cloud.seed), kCloudFieldStream, 1).k0;
    const std::vector<FieldCloud> clouds = strew(place, draws, seed);
    for (std::size_t i = 0; i < clouds.size(); ++i) {
        CloudInGrid one = place;
        CloudSettings& c = one.cloud;
        const auto between = [&](double low, double high) {
            return low + (high - low) * double(draws.between(0.0f, 1.0f));
        };
        // Large clouds are taller for their width, slimmer towers on them, and live longer.
        const double r = clouds[i].radius, big = r / (r + 250), u = between(0, 1);
        c.seed = place.cloud.seed + std::int64_t(i + 1) * 1000003;
        c.radius_m = r;
        c.height_m = std::min(r * (0.6 + 0.7 * big) * between(0.75, 1.3), place.cloud.height_m);
        c.turrets = std::max(std::int64_t(1), std::int64_t(2 + 1.4 * double(c.turrets) * big));
        c.slimness = std::min(1.0, c.slimness * (1.5 - 0.6 * big));
        c.age = std::min(1.0, c.age * u * u * (3.6 - 2.0 * big));
        one.foot_m = {place.bounds_m[0].x + clouds[i].x, place.bounds_m[0].y + clouds[i].y,
                      place.foot_m.z};
        if (c.lives()) live_in_turn(place.cloud, i, clouds[i].radius, c);
        CloudHeap heap;
        PILEUS_TRY(grow_cloud(c, heap));
        PILEUS_TRY(make_heap(one, heap, with, volume));
    }
    return Status::ok();
}

}  // namespace pileus
