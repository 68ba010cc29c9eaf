// SPDX-License-Identifier: Apache-2.0
// See sky_level.h. Places, densities and solutions.
#include "src/picture/ordinates/sky_level.h"

#include <cmath>

#include "src/picture/ordinates/ordinate_half.h"
#include "src/picture/ordinates/ordinate_medium.h"

namespace pileus {
namespace {

SkySampleParams sample_params(const SkyOrdinateAsk& ask, const SkyLevel& level) {
    SkySampleParams k{};
    k.march = *ask.march;
    k.sky = *ask.sky;
    k.places = node_places(level);
    for (std::size_t a = 0; a < 3; ++a) k.places.size[a] *= level.nodes.within[a];
    for (std::size_t a = 0; a < 2; ++a) k.places.step[a] /= float(level.nodes.within[a]);
    // As narrow as its height, however wide: a mean over clouds and gaps between them would be lit
    // through the gaps.
    k.width_m = ask.sky->height_m / float(k.places.size[2]);
    RaymarchLight& light = k.march.light;
    // A way without a number of steps would be followed to the horizon in steps of a voxel.
    if (light.steps == 0) {
        light.steps = 12, light.growth = 1.6f;
        light.first_m = 0.5f * ask.sky->height_m / float(level.nodes.grid.size[2]);
    }
    return k;
}
std::uint32_t rows_in(const SkyPlaces& at) { return std::uint32_t(at.size[1] * at.size[2]); }

}  // namespace

SkyPlaces node_places(const SkyLevel& level) {
    SkyPlaces at{};
    for (int a = 0; a < 3; ++a) at.size[a] = level.nodes.grid.size[a];
    for (int a = 0; a < 2; ++a) at.low[a] = float(level.low[a]), at.step[a] = float(level.step[a]);
    return at;
}

std::array<double, 2> low_of(const SkyOrdinates& of, std::size_t l, const SkyParams& sky,
                             const CameraParams& camera) {
    std::array<double, 2> low{};
    for (std::size_t a = 0; a < 2; ++a) {
        const double step = of.levels[l].step[a], width = of.sizes.size[a] * step;
        const double moves = kMovedNodes * step;
        low[a] = (std::floor(double(camera.origin[a]) / moves) + 0.5) * moves - 0.5 * width;
        if (sky.boxed != 0)
            low[a] = std::max(0.0, std::min(low[a], double(sky.extent_m[a]) - width));
    }
    return low;
}

void place_level(const Context& context, const Medium& medium, const SkyOrdinateAsk& ask,
                 const std::array<double, 2>& low, SkyLevel& level) {
    const StageClock clock(context, "ordinates");
    level.low = low;
    level.solved = false;
    level.nodes.sets.clear();
    SkySampleParams k = sample_params(ask, level);
    run_host_rows(context, host_kernels(context.kernels).sky_sample_rows, k,
                  SkySampleBuffers{level.nodes.samples.data(), nullptr}, rows_in(k.places));
    average_samples(context, level.nodes.samples, level.nodes);
    weigh_half(level.nodes);
    level.nodes.depth = node_depth(medium, level.nodes);
}

Status solve_level(const Context& context, const Medium& medium, const Majorants& majorants,
                   const Lighting& lighting, const SkyOrdinateAsk& ask, const SkyLevel* coarser,
                   const std::vector<OrdinateSet>& lights, int only, int iterations,
                   Buffer<float>& depths, SkyLevel& level) {
    OrdinateAsk own;
    own.depths = &depths;
    own.sampled = true;
    own.only = only;
    own.iterations = iterations;
    if (lighting.sunlit && (only < 0 || lights[std::size_t(only)].beam > 0)) {
        const StageClock clock(context, "ordinates");
        SkySampleParams k = sample_params(ask, level);
        k.sunward = 1;
        PILEUS_TRY(allocate(arrays::ordinate_depths(level.nodes.samples.size()), depths));
        run_host_rows(context, host_kernels(context.kernels).sky_sample_rows, k,
                      SkySampleBuffers{level.nodes.samples.data(), depths.data()},
                      rows_in(k.places));
    }
    if (coarser != nullptr) {
        own.coarser.nodes = &coarser->nodes;
        own.coarser.larger = &coarser->nodes.half.nodes;
        for (std::size_t a = 0; a < 2; ++a) {
            own.coarser.step[a] = level.step[a] / coarser->step[a];
            own.coarser.first[a] =
                (level.low[a] + 0.5 * level.step[a] - coarser->low[a]) / coarser->step[a] - 0.5;
        }
    }
    // What is known of a level is what its first light is of.
    if (only <= 0) {
        level.to_sun = lighting.to_sun;
        level.made_from = coarser != nullptr ? coarser->made : 0;
        level.moves_from = coarser != nullptr ? coarser->moves : 0;
    }
    PILEUS_TRY(make_ordinates(context, medium, majorants, lighting, own, level.nodes));
    level.solved = true;
    level.followed = iterations > 0;
    return Status::ok();
}

}  // namespace pileus
