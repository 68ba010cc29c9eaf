// SPDX-License-Identifier: Apache-2.0
// A scene as text that holds every field: two scenes with equal dumps are equal.
// in: Scene -> out: a line for each of its parts. src/scene/scene.h
#pragma once
#include <iomanip>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "src/scene/scene.h"

namespace test {

// Each function names all fields of its struct in their order. A field that is added to the struct
// and not here makes a wrong number of names, which does not compile: no dump can fall behind.

template <class Each>
void each_field(const pileus::Camera& from, Each each) {
    const auto& [position_m, target_m, up, orthographic, flux, fov_deg, height_m, resolution, depth,
                 depth_on_axis, depth_scale] = from;
    each(position_m, target_m, up, orthographic, flux, fov_deg, height_m, resolution, depth,
         depth_on_axis, depth_scale);
}

template <class Each>
void each_field(const pileus::Sun& from, Each each) {
    const auto& [present, azimuth_deg, elevation_deg, irradiance] = from;
    each(present, azimuth_deg, elevation_deg, irradiance);
}

template <class Each>
void each_field(const pileus::Sky& from, Each each) {
    const auto& [present, radiance, map, map_scale, map_rotation_deg] = from;
    each(present, radiance, map, map_scale, map_rotation_deg);
}

template <class Each>
void each_field(const pileus::Ground& from, Each each) {
    const auto& [present, altitude_m, albedo] = from;
    each(present, altitude_m, albedo);
}

template <class Each>
void each_field(const pileus::SolidSettings& from, Each each) {
    const auto& [file, albedo, position_m, rotation_deg, scale, y_up] = from;
    each(file, albedo, position_m, rotation_deg, scale, y_up);
}

template <class Each>
void each_field(const pileus::PhaseSettings& from, Each each) {
    const auto& [kind, g, g1, g2, weight, droplet_diameter_um, effective_radius_um, file] = from;
    each(kind, g, g1, g2, weight, droplet_diameter_um, effective_radius_um, file);
}

template <class Each>
void each_field(const pileus::SkyNoise& from, Each each) {
    const auto& [tile_m, gain, cells, octaves] = from;
    each(tile_m, gain, cells, octaves);
}

template <class Each>
void each_field(const pileus::SkySettings& from, Each each) {
    const auto& [type, perlin, worley, scale, blend, roughness, size, seed, threshold_low,
                 threshold_high, density, coverage, base_m, top_m, base_rise, top_fall, rounding,
                 base_density, planet_radius_m, wind_m_per_s, time_s, evaluate] = from;
    each(type, perlin, worley, scale, blend, roughness, size, seed, threshold_low, threshold_high,
         density, coverage, base_m, top_m, base_rise, top_fall, rounding, base_density,
         planet_radius_m, wind_m_per_s, time_s, evaluate);
}

template <class Each>
void each_field(const pileus::MediumSettings& from, Each each) {
    const auto& [density, file, format, grid, raw_type, raw_size, raw_big_endian, has_bounds,
                 bounds_m, resolution, shape_seed, sky, extinction_per_m, extinction_scale, albedo,
                 phase, periodic, y_up] = from;
    each(density, file, format, grid, raw_type, raw_size, raw_big_endian, has_bounds, bounds_m,
         resolution, shape_seed, sky, extinction_per_m, extinction_scale, albedo, phase, periodic,
         y_up);
}

template <class Each>
void each_field(const pileus::CollectorSettings& from, Each each) {
    const auto& [photons, generations, bands, samples, local_tracking, lobe_closure, camera_closure,
                 cell_voxels, paper, billboards, compositor, rejection_sampler, variance_field,
                 variance_radius, density_range, influence_radius, radius_factor, axis_degrees,
                 first_order_split, window, accumulation] = from;
    each(photons, generations, bands, samples, local_tracking, lobe_closure, camera_closure,
         cell_voxels, paper, billboards, compositor, rejection_sampler, variance_field,
         variance_radius, density_range, influence_radius, radius_factor, axis_degrees,
         first_order_split, window, accumulation);
}

template <class Each>
void each_field(const pileus::PathSettings& from, Each each) {
    const auto& [samples_per_pixel, max_depth, centre, target_error, max_samples_per_pixel] = from;
    each(samples_per_pixel, max_depth, centre, target_error, max_samples_per_pixel);
}

template <class Each>
void each_field(const pileus::RaymarchSettings& from, Each each) {
    const auto& [integrator, steps, spacing, first_step_m, growth, stretch, forward, many, octaves,
                 octave_extinction, octave_share, octave_anisotropy, cone_deg, forward_share, light,
                 light_steps, light_first_step_m, light_growth, sky_ambient, detail, light_cone,
                 jitter, jitter_share, grid_lock_m, powder, powder_strength, ambient, stop_below,
                 scale, temporal, upsample, peak_phase] = from;
    each(integrator, steps, spacing, first_step_m, growth, stretch, forward, many, octaves,
         octave_extinction, octave_share, octave_anisotropy, cone_deg, forward_share, light,
         light_steps, light_first_step_m, light_growth, sky_ambient, detail, light_cone, jitter,
         jitter_share, grid_lock_m, powder, powder_strength, ambient, stop_below, scale, temporal,
         upsample, peak_phase);
}

template <class Each>
void each_field(const pileus::OutputSettings& from, Each each) {
    const auto& [files, report, layer_depth, layer_error, layer_cloud, layer_optical_depth,
                 layer_transmittance, layer_light, layer_order] = from;
    each(files, report, layer_depth, layer_error, layer_cloud, layer_optical_depth,
         layer_transmittance, layer_light, layer_order);
}

template <class Each>
void each_field(const pileus::Animation& from, Each each) {
    const auto& [present, frames, camera_orbit_deg, sun_elevation_deg, moves_camera, moves_sun] =
        from;
    each(present, frames, camera_orbit_deg, sun_elevation_deg, moves_camera, moves_sun);
}

/// All but the text and where it came from.
template <class Each>
void each_field(const pileus::Scene& from, Each each) {
    const auto& [seed, camera, sun, sky, ground, solids, media, method, collectors, path, raymarch,
                 output, animation, text, file, directory] = from;
    (void)text, (void)file, (void)directory;
    each(seed, camera, sun, sky, ground, solids, media, method, collectors, path, raymarch, output,
         animation);
}

template <class Value>
void put(std::ostream& to, const Value& value);

template <class List>
void put_list(std::ostream& to, const List& list) {
    to << '[';
    for (const auto& value : list) put(to, value);
    to << "] ";
}
template <class Value, std::size_t N>
void put_one(std::ostream& to, const std::array<Value, N>& list) {
    put_list(to, list);
}
template <class Value>
void put_one(std::ostream& to, const std::vector<Value>& list) {
    put_list(to, list);
}
inline void put_one(std::ostream& to, const std::string& text) { to << std::quoted(text) << ' '; }
template <class Struct>
void put_one(std::ostream& to, const Struct& from) {
    to << "{";
    each_field(from, [&to](const auto&... field) { (put(to, field), ...); });
    to << "}\n";
}

/// A value and a space, or all fields of a struct and a new line.
template <class Value>
void put(std::ostream& to, const Value& value) {
    if constexpr (std::is_enum<Value>::value)
        to << int(value) << ' ';
    else if constexpr (std::is_arithmetic<Value>::value)
        to << value << ' ';
    else
        put_one(to, value);
}

/// Every value of a scene, or of a part of one, with all its digits.
template <class Part>
std::string dump(const Part& part) {
    std::ostringstream text;
    text.precision(17);
    put(text, part);
    return text.str();
}

}  // namespace test
