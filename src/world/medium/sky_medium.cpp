// SPDX-License-Identifier: Apache-2.0
// See sky_medium.h.
#include "src/world/medium/sky_medium.h"

#include <cmath>

#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

/// A layer without bounds has a box around the camera, where floats tell places best.
MediumSettings placed(const Scene& scene) {
    MediumSettings settings = scene.media[0];
    settings.box.periodic = false;
    if (settings.box.has_bounds) return settings;
    constexpr double kReach = 16000, kSpare = 50;  // a bent layer sinks by 40 m in a corner
    const Double3& camera = scene.camera.position_m;
    Double3 low, high;
    for (std::size_t a = 0; a < 2; ++a) {
        low[a] = std::floor(camera[a]) - kReach;
        high[a] = low[a] + 2 * kReach;
    }
    low[2] = settings.sky.base_m - kSpare, high[2] = settings.sky.top_m + kSpare;
    // A layer that stands on the ground, or just above it, ends there.
    const Ground& ground = scene.ground;
    if (ground.present && settings.sky.base_m >= ground.altitude_m && low[2] < ground.altitude_m)
        low[2] = ground.altitude_m;
    settings.box.has_bounds = true;
    settings.box.bounds_m = {low, high};
    return settings;
}

}  // namespace

bool is_direct_sky(const Scene& scene) {
    if (scene.media.size() != 1) return false;
    const DensityRow* row = density_row(scene.media[0].density);
    return row != nullptr && row->has_field &&
           scene.media[0].sky.evaluate == SkyEvaluation::kDirect;
}

Status outline_sky(const Scene& scene, const Limits& limits, Medium& medium, MediumSource& source) {
    PILEUS_TRY(outline_medium(scene, placed(scene), limits, medium, source));
    // What is kept is a row of its own.
    source.making[0].bytes = sky_bytes(scene.media[0].sky).making;
    return Status::ok();
}

Status load_sky(const Scene& scene, const Context& context, Medium& medium, SkyField& sky) {
    const MediumSettings& settings = scene.media[0];
    PILEUS_TRY(load_medium(scene, placed(scene), context.threads, medium, context.kernels, &sky));
    bound_sky(settings.box.has_bounds && !settings.box.periodic ? medium.extent_m : nullptr, sky);
    // The grid may miss what the noise holds: it must not tell that there is nothing.
    if (settings.sky.coverage != 0 && !(medium.density_max > 0)) medium.density_max = 1;
    return Status::ok();
}

void add_sky_rows(const SkySettings& settings, Stage last, MemoryTable& table) {
    table.add("noises of the sky in place", Stage::kDensity, last, sky_bytes(settings).kept);
}

}  // namespace pileus
