// SPDX-License-Identifier: Apache-2.0
// See world.h.
#include "src/world/world.h"

#include "src/base/file.h"
#include "src/base/number_text.h"
#include "src/base/reading_limit.h"
#include "src/base/single.h"
#include "src/io/particles/placed_particles.h"
#include "src/io/volumes/weather_file.h"
#include "src/plan/scene_limits.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"
#include "src/scene/rows/volume_format.h"
#include "src/scene/toml/toml_tree.h"
#include "src/world/medium/detail.h"
#include "src/world/medium/mix_media.h"
#include "src/world/medium/refine.h"
#include "src/world/medium/sky_medium.h"

namespace pileus {
namespace {

/// A scene without media still has a sky and a ground to show.
Status empty_medium(const Scene& scene, Medium& medium) {
    medium.low_m = scene.camera.target_m;
    for (std::size_t a = 0; a < 3; ++a) {
        medium.extent_m[a] = 1;
        medium.volume.size[a] = medium.grid.size[a] = 1;
        medium.grid.cell_m[a] = 1;
    }
    return allocate(arrays::density(medium.grid), medium.volume.density);
}

Status copy_cells(const Volume& from, Volume& to) {
    const Span<const float> cells = from.density.span();
    PILEUS_TRY(to.density.resize(cells.size, "density as it was given"));
    std::memcpy(to.density.data(), cells.data, cells.size * sizeof(float));
    to.size = from.size;
    return Status::ok();
}

/// Cells as deep as light may be kept in, and where photons begin in them.
Status refine_cells(const Context& context, World& world) {
    Medium& medium = world.medium;
    const std::array<int, 3> factor = finer_cells(medium, context.limits);
    world.refined = !world.data_cells && factor != std::array<int, 3>{1, 1, 1};
    if (world.refined) {
        world.media_plan.need(told_finer_cells(medium, factor).c_str());
        keep_larger({"density before its finer cells",
                     bytes_of(4, voxel_count(medium.grid), std::uint64_t(medium.count)), 0},
                    world.source.making);
        if (world.given && medium.count == 1) {
            world.source.unrefined_voxels = voxel_count(medium.grid);
            if (!medium.volume.density.empty())
                PILEUS_TRY(copy_cells(medium.volume, world.unrefined));
        }
        PILEUS_TRY(refine_medium(factor, context.threads, medium));
    }
    PILEUS_TRY(make_emitters(medium));
    world.source.emitters = medium.emitters.size();
    return Status::ok();
}

Status outline_medium_of(const Scene& scene, const HostMedia& given, const Context& context,
                         World& world) {
    if (scene.media.empty()) return empty_medium(scene, world.medium);
    if (world.direct_sky) return outline_sky(scene, context.limits, world.medium, world.source);
    PILEUS_TRY(outline_media(scene, context.limits, std::uint64_t(context.threads),
                             world.media_plan, world.medium, world.source, given));
    return refine_cells(context, world);
}

Status load_medium_of(const Scene& scene, const HostMedia& given, const Context& context,
                      World& world) {
    if (scene.media.empty()) return Status::ok();
    const StageClock clock(context, "density");
    world.media_plan = Plan{};
    if (world.direct_sky) return load_sky(scene, context, world.medium, world.layer);
    PILEUS_TRY(load_media(scene, context.limits, context.threads, world.media_plan, world.medium,
                          context.kernels, given));
    if (given.weather != nullptr) close_weather_files(scene, *given.weather);
    PILEUS_TRY(refine_cells(context, world));
    world.source.mean_density = mean_density(world.medium);
    return Status::ok();
}

/// The grid of particles that are shown themselves.
HostMedia for_shadows(const HostMedia& given) {
    HostMedia out;
    out.media = {given.of(0)};
    out.media[0].shadows_only = true;
    return out;
}

/// Reads or makes the particles once, for the method and for the grid that casts their shadows.
Status load_particles_of(const Scene& scene, const HostMedia& given, const Context& context,
                         World& world) {
    const MediumSettings& settings = scene.media[0];
    const DensityRow* row = density_row(settings.density);
    {
        const StageClock clock(context, "particles");
        const std::string key = medium_key(scene, settings) + ".density";
        PILEUS_TRY(at_key(
            scene, key,
            row != nullptr
                ? row->make_particles(settings, context.threads, world.particles)
                : read_placed_particles(settings, density_path(scene, settings), world.particles,
                                        given.of(0).particles,
                                        [&](double share) { context.tell("particles", share); })));
    }
    HostMedia read = for_shadows(given);
    read.media[0].placed = &world.particles;
    PILEUS_TRY(load_medium_of(scene, read, context, world));
    if (settings.source.y_up) turn_particles_y_up(world.particles);
    const double scale =
        row != nullptr ? settings.optics.extinction_per_m : settings.optics.extinction_scale;
    for (float& v : world.particles.density.span()) {
        const double per_m = double(v) * scale;
        if (!(per_m <= kMaxSigma))
            return Status::bad_input(medium_key(scene, settings) + ": a particle of " +
                                     number_text(per_m) + " per m, allowed: at most " +
                                     number_text(kMaxSigma));
        v = float(single_or_0(per_m));
    }
    return Status::ok();
}

}  // namespace

bool shows_particles(const Scene& scene) {
    if (scene.media.size() != 1) return false;
    if (const DensityRow* row = density_row(scene.media[0].density))
        return row->make_particles != nullptr;
    return is_particle_format(scene.media[0].source.format);
}

Status outline_world(const Scene& scene, WorldUse use, const HostMedia& given,
                     const Context& context, World& world) {
    PILEUS_TRY(check_scene_limits(scene, context.limits));
    const ReadingLimit readers(context.limits);
    PILEUS_TRY(outline_solids(scene, context, world.solids));
    world.media = scene.media.size();
    const bool cells = given.of(0).cells != nullptr;
    for (const MediumValues& values : given.media)
        world.given = world.given || values.cells != nullptr || values.particles != nullptr;
    world.data_cells = use == WorldUse::kDataCells;
    world.direct_sky = use == WorldUse::kSkyInPlace && !cells && is_direct_sky(scene);
    world.shows_particles = use == WorldUse::kParticles && !cells && shows_particles(scene);
    const HostMedia shadows = world.shows_particles ? for_shadows(given) : HostMedia{};
    return outline_medium_of(scene, world.shows_particles ? shadows : given, context, world);
}

Status load_world(const Scene& scene, const HostMedia& given, const Context& context,
                  World& world) {
    const ReadingLimit readers(context.limits);
    if (world.shows_particles)
        PILEUS_TRY(load_particles_of(scene, given, context, world));
    else
        PILEUS_TRY(load_medium_of(scene, given, context, world));
    PILEUS_TRY(load_solids(scene, world.medium.low_m, context, world.solids));
    if (!world.medium.grid.periodic) return Status::ok();
    return repeat_solids(scene, world.medium.extent_m, world.solids);
}

}  // namespace pileus
