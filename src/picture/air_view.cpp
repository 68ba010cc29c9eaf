// SPDX-License-Identifier: Apache-2.0
// See air_view.h.
#include "src/picture/air_view.h"

#include <algorithm>

#include "kernels_cpu/core/profile.h"
#include "src/picture/march_view.h"
#include "src/picture/night/night_view.h"
#include "src/picture/sun_disc.h"

namespace pileus {
namespace {

/// The sun's or the moon's disc. Through the media it is dimmed as the sky is; where a host lays
/// them over it, later.
void show_disc(const CameraParams& camera, const FarLight& of, SunDisc disc, const Planes& planes,
               const AirPlanes& on, const Atmosphere& air) {
    disc.horizon = double(air.sky.horizon);
    const double height_km = std::min(air.camera_km, 0.999 * (kAirTopKm - kEarthRadiusKm));
    disc.irradiance = sunlight(air.tables, height_km, double(disc.to_sun[2]));
    for (std::size_t c = 0; c < 3; ++c) disc.irradiance[c] *= of.above[int(c)];
    add_sun_disc(camera, disc, planes.opaque_depth.span(),
                 on.through ? planes.transmittance.span() : Span<const float>{}, on.behind);
}

void show_discs(const Scene& scene, const Lighting& lighting, const CameraParams& camera,
                const Planes& planes, const AirPlanes& on, const Atmosphere& air) {
    const auto aimed = [&](const FarLight& of) {
        SunDisc disc;
        const Double3 to = towards_deg(of.azimuth_deg, of.elevation_deg);
        for (int a = 0; a < 3; ++a)
            disc.to_sun[a] = &of == &air ? lighting.to_sun[std::size_t(a)] : float(to[a]);
        return disc;
    };
    if (scene.atmosphere.sun_disc) {
        SunDisc sun = aimed(air.sun());
        if (scene.sun.angular_radius_deg > 0) sun.radius_deg = scene.sun.angular_radius_deg;
        show_disc(camera, air.sun(), sun, planes, on, air);
    }
    if (!air.has_moon) return;
    SunDisc moon = aimed(air.moon());
    moon.radius_deg = air.moon_radius_deg;
    for (std::size_t a = 0; a < 3; ++a) moon.lit_from[a] = scene.night.moon_to_sun[int(a)];
    show_disc(camera, air.moon(), moon, planes, on, air);
}

/// What the air of the other light sends, before and behind everything. The first light's rows have
/// dimmed what is there.
Status add_other_sky(const Context& context, const Atmosphere& air, AirRowsParams k,
                     AirRowsBuffers b) {
    const std::size_t count =
        std::size_t(3) * std::size_t(k.camera.width) * std::size_t(k.camera.height);
    const Double3 to = towards_deg(air.other.azimuth_deg, air.other.elevation_deg);
    for (int c = 0; c < 3; ++c) {
        k.to_sun[c] = float(to[c]);
        k.above[c] = float(air.other.above[c]);
    }
    Buffer<float> light, behind;
    PILEUS_TRY(light.resize(count, "air"));
    PILEUS_TRY(behind.resize(count, "air"));
    float *const all_light = b.light, *const all_behind = b.behind;
    b.sky = air.other.sky.texels.data();
    b.air = air.other.near.data();
    b.light = light.data();
    b.behind = behind.data();
    b.dimmed = b.kept = nullptr;
    PILEUS_TRY(run_rows(context, context.kernels->air_rows, k, b, std::uint32_t(k.camera.height)));
    for (std::size_t i = 0; i < count; ++i) {
        all_light[i] += light[i];
        all_behind[i] += behind[i];
    }
    return Status::ok();
}

}  // namespace

Status run_air(const Context& context, const Scene& scene, const Medium& medium,
               const Lighting& lighting, const CameraParams& camera, Environment& environment,
               const Planes& planes, const AirPlanes& on) {
    const StageClock clock(context, "air");
    Atmosphere& air = environment.air;
    const double sea_m = scene.ground.present ? scene.ground.altitude_m : 0;
    PILEUS_TRY(look_from(medium.low_m[2] + double(camera.origin[2]) - sea_m, context.threads, air));
    AirRowsParams k{};
    k.medium = make_medium_view(medium, Majorants{});
    k.camera = camera;
    k.haze_g = air.sky.haze_g;
    for (int c = 0; c < 3; ++c) {
        k.to_sun[c] = lighting.to_sun[std::size_t(c)];
        k.above[c] = float(air.above[c]);
    }
    const Air& clear = air.tables.air;
    for (int c = 0; c < 3; ++c) {
        k.rayleigh[c] = clear.rayleigh[c];
        k.haze[c] = clear.haze_all[c];
        k.ozone[c] = clear.ozone[c];
    }
    k.horizon = air.sky.horizon;
    k.downs = kSkyDowns;
    k.ups = kSkyUps;
    k.turns = kSkyTurns;
    k.rows = kAirRows;
    k.columns = kAirColumns;
    k.slices = kAirSlices;
    k.height = float(1000 * air.camera_km);
    const double room = kAirTopKm - kEarthRadiusKm - air.camera_km;
    k.room = float(room > 0 ? 1000 * room : 0);
    k.reach = float(air.reach_m);
    k.solid = planes.opaque_depth.empty() ? 0 : 1;
    k.through = on.through ? 1 : 0;
    const AirRowsBuffers b{air.sky.texels.data(),
                           air.near.data(),
                           planes.transmittance.data(),
                           planes.half_depth.data(),
                           planes.opaque_depth.data(),
                           on.light,
                           on.behind,
                           on.dimmed,
                           on.kept};
    PILEUS_TRY(run_rows(context, context.kernels->air_rows, k, b, std::uint32_t(camera.height)));
    if (air.two_skies) PILEUS_TRY(add_other_sky(context, air, k, b));
    const SkySeen seen{camera, planes.opaque_depth.span(),
                       on.through ? planes.transmittance.span() : Span<const float>{}, on.behind};
    show_night(context.threads, air, seen, on.bodies);
    if (on.bodies) show_discs(scene, lighting, camera, planes, on, air);
    return Status::ok();
}

Status show_air(const Context& context, const Scene& scene, const Medium& medium,
                const Lighting& lighting, const CameraParams& camera, Environment& environment,
                Planes& planes) {
    if (!kAtmosphere || !environment.air.present() || camera.flux != 0) return Status::ok();
    const std::size_t pixels = planes.transmittance.size();
    const std::size_t parts = planes.colour.size() / (3 * pixels);
    Buffer<float> dimmed;
    if (parts > 1) {
        PILEUS_TRY(dimmed.resize(3 * pixels, "air"));
        for (float& v : dimmed.span()) v = 1;
    }
    PILEUS_TRY(run_air(
        context, scene, medium, lighting, camera, environment, planes,
        {planes.colour.data(), planes.background.data(), dimmed.empty() ? nullptr : dimmed.data(),
         false, planes.kept.empty() ? nullptr : planes.kept.data()}));
    // Parts of the light tell its noise, to which the air adds none.
    for (std::size_t i = 3 * pixels; i < planes.colour.size(); ++i)
        planes.colour[i] *= dimmed[i % (3 * pixels)];
    return Status::ok();
}

}  // namespace pileus
