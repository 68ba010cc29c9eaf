// SPDX-License-Identifier: Apache-2.0
// See world.h: what is seen of a world through one camera and under one sky.
// in: a scene, a world -> out: air, sky map, depths; lights.
// docs/architecture.md, "One way through".
#include "kernels_cpu/core/profile.h"
#include "src/base/digest.h"
#include "src/world/world.h"

namespace pileus {
Status outline_surroundings(const Scene& scene, const Context& context, const World& world,
                            const Image* sky, Surroundings& around) {
    PILEUS_TRY(outline_camera_depth(scene, context, around.depth));
    if (!kAtmosphere || !scene.atmosphere.present)
        return read_sky_map(scene, context, sky, around.sky_map);
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

std::uint64_t bytes_of_world(const World& world) {
    std::uint64_t bytes = world.medium.volume.density.bytes() + world.medium.parts.bytes() +
                          phase_bytes(world.medium) + world.solids.nodes.bytes() +
                          world.solids.triangles.bytes() + world.solids.albedo.bytes() +
                          world.particles.position.bytes() + world.particles.radius.bytes() +
                          world.particles.density.bytes() + world.particles.colour.bytes() +
                          world.particles.emission.bytes() + world.particles.velocity.bytes() +
                          world.particles.id.bytes();
    for (const NoiseTexture* noise : {&world.layer.perlin, &world.layer.worley})
        bytes += noise->words.bytes();
    bytes += world.medium.detail.tile.bytes();
    return bytes;
}

std::string density_digest(const World& world) {
    if (!world.density_digest.empty()) return world.density_digest;
    Digest digest;
    digest.floats(world.medium.volume.density.span());
    for (const NoiseTexture* noise : {&world.layer.perlin, &world.layer.worley})
        digest.words(noise->words.span());
    if (world.medium.count > 1) digest.floats(world.medium.parts.span());
    const MediumDetail& detail = world.medium.detail;
    if (detail.present()) {
        digest.floats(detail.tile.span());
        digest.floats({detail.view.period, 3});
        const float numbers[] = {detail.view.strength, detail.view.core};
        digest.floats({numbers, 2});
    }
    return digest.hex();
}

}  // namespace pileus
