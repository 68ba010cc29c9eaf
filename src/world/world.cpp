// SPDX-License-Identifier: Apache-2.0
// See world.h.
#include "src/world/world.h"

#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/io/particles/placed_particles.h"
#include "src/plan/scene_limits.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"
#include "src/scene/rows/volume_format.h"
#include "src/world/medium/mix_media.h"
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

Status outline_medium_of(const Scene& scene, const Context& context, World& world) {
    if (scene.media.empty()) return empty_medium(scene, world.medium);
    if (world.direct_sky) return outline_sky(scene, context.limits, world.medium, world.source);
    return outline_media(scene, context.limits, std::uint64_t(context.threads), world.media_plan,
                         world.medium, world.source);
}

Status load_medium_of(const Scene& scene, const Context& context, World& world) {
    if (scene.media.empty()) return Status::ok();
    const StageClock clock(context, "density");
    world.media_plan = Plan{};
    if (world.direct_sky) return load_sky(scene, context, world.medium, world.layer);
    PILEUS_TRY(load_media(scene, context.limits, context.threads, world.media_plan, world.medium,
                          context.kernels));
    world.source.mean_density = mean_density(world.medium);
    return Status::ok();
}

/// Reads or makes the particles once, for the method and for the grid that casts their shadows.
Status load_particles_of(const Scene& scene, const Context& context, World& world) {
    Scene own = scene;
    MediumSettings& medium = own.media[0];
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
                                        [&](double share) { context.tell("particles", share); })));
    }
    medium.particles.shadows_only = true;
    medium.particles.placed = &world.particles;
    PILEUS_TRY(load_medium_of(own, context, world));
    if (settings.y_up) turn_particles_y_up(world.particles);
    const double scale = row != nullptr ? settings.extinction_per_m : settings.extinction_scale;
    for (float& v : world.particles.density.span()) v = float(double(v) * scale);
    return Status::ok();
}

/// Lights, and with them the plan, depend on the map's colours, so that it is read at once.
Status read_sky_map(const Scene& scene, const Context& context, SkyMap& map) {
    if (scene.sky.map.empty()) return Status::ok();
    const StageClock clock(context, "sky map");
    InputFile file;
    const std::string path = scene_path(scene.directory, scene.sky.map);
    PILEUS_TRY(at_key(scene, "sky.map", open_file(path, file)));
    PILEUS_TRY(
        at_key(scene, "sky.map", check_limit(context.limits, LimitId::kFile, file.size(), path)));
    return at_key(scene, "sky.map", load_sky_map(scene, map));
}

}  // namespace

bool shows_particles(const Scene& scene) {
    if (scene.media.size() != 1 || scene.media[0].values != nullptr) return false;
    if (const DensityRow* row = density_row(scene.media[0].density))
        return row->make_particles != nullptr;
    return is_particle_format(scene.media[0].format);
}

Status outline_world(const Scene& scene, WorldUse use, const Context& context, World& world) {
    PILEUS_TRY(check_scene_limits(scene, context.limits));
    PILEUS_TRY(outline_solids(scene, context, world.solids));
    world.media = scene.media.size();
    world.direct_sky = use == WorldUse::kSkyInPlace && is_direct_sky(scene);
    world.shows_particles = use == WorldUse::kParticles && shows_particles(scene);
    if (!world.shows_particles) return outline_medium_of(scene, context, world);
    Scene own = scene;
    for (MediumSettings& m : own.media) m.particles.shadows_only = true;
    return outline_medium_of(own, context, world);
}

Status load_world(const Scene& scene, const Context& context, World& world) {
    if (world.shows_particles)
        PILEUS_TRY(load_particles_of(scene, context, world));
    else
        PILEUS_TRY(load_medium_of(scene, context, world));
    PILEUS_TRY(load_solids(scene, world.medium.low_m, context, world.solids));
    if (!world.medium.grid.periodic) return Status::ok();
    return repeat_solids(scene, world.medium.extent_m, world.solids);
}

Status outline_surroundings(const Scene& scene, const Context& context, const World& world,
                            Surroundings& around) {
    PILEUS_TRY(outline_camera_depth(scene, context, around.depth));
    if (!scene.atmosphere.present) return read_sky_map(scene, context, around.sky_map);
    const StageClock clock(context, "atmosphere");
    return light_surroundings(scene, context.threads, world, around);
}

Status light_surroundings(const Scene& scene, int threads, const World& world,
                          Surroundings& around) {
    const Medium& medium = world.medium;
    const double sea_m = scene.ground.present ? scene.ground.altitude_m : 0;
    Image image;
    PILEUS_TRY(light_atmosphere(scene, medium.low_m[2] + 0.5 * medium.extent_m[2] - sea_m, threads,
                                around.air, image));
    SkyMap map;
    PILEUS_TRY(make_sky_map("atmosphere", image, Sky{}, scene.ground.present, map));
    around.sky_map = std::move(map);
    return Status::ok();
}

Status load_surroundings(const Scene& scene, const Context& context, Surroundings& around) {
    return read_camera_depth(scene, context, around.depth);
}

Lighting light_world(const Scene& scene, const SunPlace& sun, const World& world,
                     const Surroundings& around, Plan& plan) {
    const Scene* lit = &scene;
    Scene coloured;
    if (around.air.present()) {
        coloured.sun = scene.sun;
        coloured.sky.present = true;
        coloured.ground = scene.ground;
        coloured.lights = scene.lights;
        coloured.solids = scene.solids;
        for (std::size_t c = 0; c < 3; ++c)
            coloured.sun.irradiance[c] = float(around.air.above[c] * around.air.sunlight[c]);
        lit = &coloured;
    }
    Lighting out =
        plan_lighting(*lit, world.medium, sun, plan, &around.sky_map, &world.solids, &around.depth);
    out.air = around.air.present();
    return out;
}

std::string density_digest(const World& world) {
    Digest digest;
    digest.floats(world.medium.volume.density.span());
    for (const NoiseTexture* noise : {&world.layer.perlin, &world.layer.worley})
        for (const std::int32_t word : noise->words.span()) digest.u32(std::uint32_t(word));
    if (world.medium.count > 1) digest.floats(world.medium.parts.span());
    return digest.hex();
}

}  // namespace pileus
