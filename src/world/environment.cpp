// SPDX-License-Identifier: Apache-2.0
// See environment.h.
#include "src/world/environment.h"

#include "kernels_cpu/core/profile.h"

namespace pileus {
namespace {

/// Under an atmosphere the sun has the air's colour, and the sky is its map alone.
struct InAir {
    Sun sun;
    Sky sky;
};
InAir in_air(const Scene& scene, const Atmosphere& air) {
    InAir out{scene.sun, {}};
    out.sky.present = true;
    for (std::size_t c = 0; c < 3; ++c)
        out.sun.irradiance[c] = float(air.above[c] * air.sunlight[c]);
    return out;
}

/// Where the beams come from that light all of a scene: the sun, or the moon.
SunPlace beams_from(const Atmosphere& air, const SunPlace& sun) {
    return air.present() && air.moonlit ? SunPlace{air.azimuth_deg, air.elevation_deg} : sun;
}

/// By height, of media whose lowest level is at `low_m`.
SunHeights by_height(const Scene& scene, const Atmosphere& air, double low_m) {
    SunHeights h{};
    h.depth = air.sun_depth.data();
    h.rows = kSunRows;
    h.low = float((scene.ground.present ? scene.ground.altitude_m : 0) - low_m);
    h.rows_per_metre = float(1 / kSunRowM);
    for (int c = 0; c < 3; ++c) h.above[c] = float(air.above[c]);
    return h;
}

/// Hands what shines to `use`.
template <class Use>
auto with_shining(const Scene& scene, const World& world, const Environment& environment,
                  const Use& use) {
    const bool solids = !scene.solids.empty();
    if (!environment.air.present())
        return use(Shining{scene.sun,
                           scene.sky,
                           scene.ground,
                           scene.lights,
                           solids,
                           {},
                           &environment.look,
                           &scene.placement,
                           scene.world.wind_s});
    const InAir lit = in_air(scene, environment.air);
    return use(Shining{lit.sun, lit.sky, scene.ground, scene.lights, solids,
                       by_height(scene, environment.air, world.medium.low_m[2]), &environment.look,
                       &scene.placement, scene.world.wind_s});
}

}  // namespace

Status outline_environment(const Scene& scene, const Context& context, const World& world,
                           const Image* sky, Environment& environment) {
    outline_camera_depth(scene, environment.depth);
    PILEUS_TRY(make_ground_look(scene, context, environment.look));
    if (!kAtmosphere || !scene.atmosphere.present)
        return read_sky_map(scene, context, sky, environment.sky_map);
    const StageClock clock(context, "atmosphere");
    return relight_air(scene.atmosphere, scene, context.threads, world, environment);
}

Status load_environment(const Scene& scene, const Context& context, Environment& environment) {
    return read_camera_depth(scene, context, environment.depth);
}

Status set_sky_map(const Image* map, const Sky& sky, bool ground, Environment& environment) {
    SkyMap made;
    if (map != nullptr) PILEUS_TRY(make_sky_map("sky.map", *map, sky, ground, made));
    environment.sky_map = std::move(made);
    return Status::ok();
}

Status relight_air(const AtmosphereSettings& settings, const FrameState& frame, int threads,
                   const World& world, Environment& environment) {
    const Medium& medium = world.medium;
    const Ground& ground = frame.ground;
    const double sea_m = ground.present ? ground.altitude_m : 0;
    const double height_m = medium.low_m[2] + 0.5 * medium.extent_m[2] - sea_m;
    Ground lit = ground;
    lit.albedo = ground_albedo(environment.look, ground.albedo,
                               stand_of(medium, {}, sea_m - medium.low_m[2]), 1)
                     .even;
    Image image;
    PILEUS_TRY(light_atmosphere(settings, frame.sun, lit, height_m, threads, environment.air, image,
                                frame.night));
    SkyMap map;
    PILEUS_TRY(make_sky_map("atmosphere", image, Sky{}, ground.present, map));
    environment.sky_map = std::move(map);
    return Status::ok();
}

Lighting light_of(const Scene& scene, const SunPlace& sun, const World& world,
                  const Environment& environment) {
    return with_shining(scene, world, environment, [&](const Shining& shining) {
        Lighting out = make_lighting(shining, world.medium, beams_from(environment.air, sun),
                                     &environment.sky_map, &world.solids, &environment.depth);
        out.air = environment.air.present();
        return out;
    });
}

void explain_light(const Scene& scene, const SunPlace& sun, const World& world,
                   const Environment& environment, const Lighting& made, Plan& plan) {
    with_shining(scene, world, environment, [&](const Shining& shining) {
        explain_lighting(shining, world.medium, beams_from(environment.air, sun), made, plan);
    });
    if (environment.air.present() && environment.air.moonlit)
        plan.leave_out("sun's beams", "the moon lights the media more");
}

}  // namespace pileus
