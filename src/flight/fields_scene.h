// SPDX-License-Identifier: Apache-2.0
// Members of a scene, for archives. What only reading a text needs is left out: its text, places
// of its keys, overrides, names of files.
// in: Scene -> out: every value that a session reads, in a fixed order.
// docs/flight.md, "Packed scenes"; tests/flight/pack_test.cpp finds a key that is missing here
#pragma once
#include "src/flight/archive.h"
#include "src/scene/scene.h"

namespace pileus {

template <class A>
void fields(A& a, Frustum& v) {
    all(a, v.half_width, v.half_height, v.shift_x, v.shift_y);
}
template <class A>
void fields(A& a, Camera& v) {
    all(a, v.position_m, v.target_m, v.up, v.orthographic, v.flux, v.fov_deg, v.height_m,
        v.resolution, v.has_frustum, v.frustum);
}
template <class A>
void fields(A& a, Lens& v) {
    all(a, v.aperture_radius_m, v.focus_distance_m, v.shutter_s);
}
template <class A>
void fields(A& a, Sun& v) {
    all(a, v.present, v.azimuth_deg, v.elevation_deg, v.irradiance, v.angular_radius_deg);
}
template <class A>
void fields(A& a, Sky& v) {
    all(a, v.present, v.mapped, v.radiance, v.map_scale, v.map_rotation_deg);
}
template <class A>
void fields(A& a, Ground& v) {
    all(a, v.present, v.altitude_m, v.albedo);
}
template <class A>
void fields(A& a, AtmosphereSettings& v) {
    all(a, v.present, v.date, v.time, v.utc_offset_h, v.latitude_deg, v.longitude_deg, v.turbidity,
        v.ground_albedo, v.refraction, v.sun_disc, v.moon, v.stars, v.airglow);
}
template <class A>
void fields(A& a, LightSettings& v) {
    all(a, v.type, v.position_m, v.intensity, v.radius_m, v.shadow_samples, v.direction, v.target_m,
        v.cone_deg, v.penumbra_deg, v.azimuth_deg, v.elevation_deg, v.irradiance);
}
template <class A>
void fields(A& a, PhaseSettings& v) {
    all(a, v.type, v.numbers, v.file);
}
template <class A>
void fields(A& a, TransferRow& v) {
    all(a, v.value, v.extinction_per_m, v.albedo);
}
template <class A>
void fields(A& a, RecipeSettings& v) {
    all(a, v.count, v.rise_m_per_s);
}
template <class A>
void fields(A& a, ParticleSettings& v) {
    all(a, v.unit_m, v.radius_m, v.radius_scale, v.cross_section, v.plume, v.cumulus, v.count,
        v.rise_m_per_s, v.share, v.replicate, v.replicate_radius);
}
template <class A>
void fields(A& a, SkyNoise& v) {
    all(a, v.tile_m, v.gain, v.cells, v.octaves);
}
template <class A>
void fields(A& a, SkySettings& v) {
    all(a, v.type, v.perlin, v.worley, v.scale, v.blend, v.roughness, v.size, v.seed,
        v.threshold_low, v.threshold_high, v.density, v.coverage, v.base_m, v.top_m, v.base_rise,
        v.top_fall, v.rounding, v.base_density, v.planet_radius_m, v.wind_m_per_s, v.time_s,
        v.evaluate);
}
template <class A>
void fields(A& a, CloudSettings& v) {
    all(a, v.type, v.seed, v.height_m, v.radius_m, v.base_m, v.position_m, v.turrets, v.tall,
        v.slimness, v.dilution, v.entrainment_per_km, v.age, v.age_s, v.lifetime_s, v.outline,
        v.shear, v.wind_deg, v.turn_deg, v.anvil, v.plates, v.cell_m, v.cover, v.erosion, v.mamma,
        v.shelf, v.rain);
}
template <class A>
void fields(A& a, MediumSettings& v) {
    all(a, v.density, v.source.file, v.source.first_frame, v.source.format, v.source.grid,
        v.source.raw_type, v.source.raw_size, v.source.raw_big_endian, v.particles,
        v.box.has_bounds, v.box.bounds_m, v.box.resolution, v.shape_seed, v.sky, v.cloud,
        v.optics.extinction_per_m, v.optics.extinction_scale, v.optics.albedo, v.optics.emission,
        v.optics.phase, v.box.periodic, v.box.constant, v.optics.transfer, v.source.y_up);
}
template <class A>
void fields(A& a, UpsampleSettings& v) {
    all(a, v.scale, v.temporal, v.upsample);
}
template <class A>
void fields(A& a, CollectorSettings& v) {
    all(a, v.photons, v.generations, v.closure.bands, v.placement.samples, v.local_tracking,
        v.closure.lobe, v.closure.camera, v.closure.cell_voxels, v.paper, v.display.billboards,
        v.display.guided_nodes, v.display.directions, v.display.compositor,
        v.placement.rejection_sampler, v.placement.variance_field, v.placement.variance_radius,
        v.placement.density_range, v.peak_deg, v.placement.influence_radius,
        v.display.radius_factor, v.closure.axis_degrees, v.first_order_split, v.closure.window,
        v.thin, v.light_refresh, v.accumulation);
}
template <class A>
void fields(A& a, PhotonGridSettings& v) {
    all(a, v.photons, v.generations, v.ring, v.cells, v.closure, v.bands, v.axis_degrees,
        v.peak_deg, v.local_tracking, v.first_order_split, v.directions, v.thin, v.light_refresh,
        v.accumulation);
}
template <class A>
void fields(A& a, PathSettings& v) {
    all(a, v.samples_per_pixel, v.max_depth, v.centre, v.target_error, v.max_samples_per_pixel,
        v.guide, v.importance);
}
template <class A>
void fields(A& a, FilterSettings& v) {
    all(a, v.kind, v.radius_pixels);
}
template <class A>
void fields(A& a, RaymarchSettings& v) {
    all(a, v.march.integrator, v.march.steps, v.march.spacing, v.march.first_step_m, v.march.growth,
        v.march.stretch, v.scattering.forward, v.scattering.many, v.scattering.automatic,
        v.scattering.ordinates, v.scattering.octaves, v.scattering.octave_extinction,
        v.scattering.octave_share, v.scattering.octave_anisotropy, v.scattering.cone_deg,
        v.scattering.forward_share, v.light.kind, v.light.steps, v.light.first_step_m,
        v.light.growth, v.light.sky_ambient, v.march.detail, v.light.cone, v.march.jitter,
        v.march.jitter_share, v.march.grid_lock_m, v.look.powder, v.look.powder_strength,
        v.look.ambient, v.march.stop_below, v.thin, v.light.refresh, v.look.peak_phase);
}
template <class A>
void fields(A& a, OpticalDepthSettings& v) {
    all(a, v.steps, v.exact, v.resolution, v.intensity, v.ambient, v.powder_strength,
        v.powder_depth, v.powder_by_extinction, v.g, v.max_extinction_per_m, v.light_scale,
        v.stop_below);
}
template <class A>
void fields(A& a, ParticlesSettings& v) {
    ParticleOrders& o = v.octaves;
    ParticleShadows& w = v.shadows;
    all(a, v.scattering, o.count, o.extinction, o.share, o.anisotropy, o.cone_deg, v.sky_ambient,
        v.bins, v.leaf, v.light, w.density, w.occluders, w.bias, w.solid, v.billboards,
        v.display_scale, v.falloff, w.most_depth, v.stop_below);
}

/// Sessions have one camera and no film.
template <class A>
void fields(A& a, Scene& v) {
    all(a, v.seed, v.camera, v.lens, v.sun, v.sky, v.ground, v.atmosphere, v.lights, v.media,
        v.method, v.collectors, v.path, v.filter, v.raymarch, v.optical_depth, v.photon_grid,
        v.particles, v.file);
}

}  // namespace pileus
