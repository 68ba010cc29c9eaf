// SPDX-License-Identifier: Apache-2.0
// Scenes and settings of every method, small, for sessions that are moved about.
// in: nothing -> out: rows of a table.
// tests/embed/settings_test.cpp
#pragma once
#include "tests/embed/host_harness.h"

namespace settings_test {

using host_test::Overrides;

constexpr const char* kLamps = R"(
[[light]]
type = "point"
position_m = [100, -250, 900]
intensity = [6e4, 4e4, 2e4]
radius_m = 60
[[light]]
type = "spot"
position_m = [0, -900, 100]
target_m = [0, 0, 1024]
cone_deg = 40
intensity = 1e6
[[light]]
type = "directional"
azimuth_deg = 200
elevation_deg = 20
irradiance = [0.1, 0.2, 0.3]
)";

/// A few particles over the grid that casts their shadows.
constexpr const char* kParticles = R"(
[camera]
position_m = [16, -4000, 256]
target_m = [0, 0, 1024]
resolution = [24, 14]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.0625, 0.125, 0.25]
[[medium]]
density = "procedural:particle-cumulus"
bounds_m = [[-768, -768, 512], [768, 768, 1536]]
resolution = [12, 12, 8]
extinction_per_m = 0.0125
particle_cumulus = { particles = 200 }
)";

/// A layer of clouds without end, looked up where rays are.
constexpr const char* kSkyInPlace = R"(
[camera]
position_m = [0, 0, 900]
target_m = [0, 3000, 1300]
[sun]
azimuth_deg = 120
elevation_deg = 30
[sky]
radiance = [0.05, 0.07, 0.11]
[ground]
[[medium]]
density = "procedural:sky"
resolution = [32, 32, 8]
sky = { type = "cumulus", coverage = 0.6, size = 32 }
[raymarch]
light_steps = 3
light_first_step_m = 60
light_growth = 2
)";

/// The same as a box.
constexpr const char* kBoxedSky = R"(
[camera]
position_m = [0, -9000, 900]
target_m = [0, 0, 1300]
[sun]
azimuth_deg = 120
elevation_deg = 30
[[medium]]
density = "procedural:sky"
bounds_m = [[-3000, -3000, 800], [3000, 3000, 2000]]
resolution = [16, 16, 8]
sky = { type = "cumulus", coverage = 0.6, size = 32, planet_radius_m = 0, evaluate = "direct" }
)";

constexpr const char* kAir = R"(
[camera]
position_m = [16, -4000, 1400]
target_m = [0, 0, 1024]
[sun]
azimuth_deg = 0
elevation_deg = 8
[atmosphere]
turbidity = 4
sun_disc = true
[[medium]]
density = "uniform:sphere"
bounds_m = [[-512, -512, 512], [512, 512, 1536]]
resolution = [8, 8, 8]
extinction_per_m = 0.002
)";

constexpr const char* kSpheres = R"(
[camera]
position_m = [0, -1500, 700]
target_m = [0, 0, 800]
[sun]
azimuth_deg = 120
elevation_deg = 30
[sky]
radiance = [0.05, 0.07, 0.11]
[ground]
[[medium]]
density = "assets/scenes/golden/data/puff.csv"
phase = { type = "henyey-greenstein", g = 0.8 }
)";

/// As many media as there may be, of every kind of phase function.
inline std::string many_media() {
    const char* const phases[] = {"{ type = \"isotropic\" }",
                                  "{ type = \"rayleigh\" }",
                                  "{ type = \"henyey-greenstein\", g = 0.7 }",
                                  "{ type = \"two-lobe\", g1 = 0.8, g2 = -0.3, weight = 0.8 }",
                                  "{ type = \"cornette-shanks\", g = 0.5 }",
                                  "{ type = \"cloud\", effective_radius_um = 10 }",
                                  "{ type = \"hg-draine\", droplet_diameter_um = 20 }",
                                  "{ type = \"henyey-greenstein\", g = -0.2 }"};
    std::string text =
        "[camera]\nposition_m = [16, -4000, 256]\ntarget_m = [0, 0, 1024]\n[sun]\nazimuth_deg = "
        "120\nelevation_deg = 35\n[sky]\nradiance = [0.0625, 0.125, 0.25]\n[ground]\n";
    for (int i = 0; i < 8; ++i)
        text += "[[medium]]\ndensity = \"uniform:sphere\"\nbounds_m = [[" +
                std::to_string(-700 + 60 * i) + ", -512, 512], [" + std::to_string(300 + 60 * i) +
                ", 512, 1536]]\nresolution = [6, 6, 6]\nextinction_per_m = 0.002\nalbedo = [0.9, " +
                std::to_string(0.9 + 0.01 * i) + ", 1.0]\nphase = " + phases[i] + "\n";
    return text;
}

/// A scene of the test: by itself, or what it adds to the small cumulus.
struct Row {
    std::string text;
    Overrides overrides;
};

/// A medium that is looked up without interpolation, and one that repeats to the sides.
constexpr const char *kFlat = "medium.0.interpolation=constant",
                     *kWide = "medium.0.boundary=periodic";
constexpr const char* kPeak = "medium.0.phase={type=\"cloud\",effective_radius_um=10}";

inline std::vector<Row> collector_rows() {
    const std::string method = "method.name=collectors";
    const auto with = [&](Overrides more) {
        more.insert(more.begin(), method);
        return more;
    };
    return {
        {"", with({})},
        {"", with({"collectors.bands=1", "collectors.first_order_split=false"})},
        {"", with({"collectors.bands=8", "collectors.axis_degrees=3", "medium.0.albedo=1"})},
        {"", with({"collectors.axis_degrees=8", "collectors.peak_deg=20", kPeak})},
        {"", with({"collectors.closure=lobe", "collectors.window=true"})},
        {"", with({"collectors.closure=camera"})},
        {"", with({"collectors.closure=camera", "camera.projection=orthographic",
                   "camera.height_m=2000", "collectors.cell_voxels=2"})},
        {"", with({"collectors.variant=paper", "collectors.display=billboards"})},
        {"", with({"collectors.display=billboards", "camera.projection=orthographic",
                   "camera.height_m=2000"})},
        {"",
         with({"collectors.display=billboards", "collectors.closure=lobe", "medium.0.albedo=1"})},
        {"", with({"collectors.directions=camera", "collectors.tracking=global"})},
        {"", with({"collectors.directions=all"})},
        {"", with({"collectors.node_filter=guided", "medium.0.albedo=0.9"})},
        {"", with({"collectors.node_filter=guided", kWide})},
        {"", with({"collectors.sampler=rejection", "collectors.density_range=0.5"})},
        {"", with({"collectors.placement=variance", "collectors.variance_radius=2"})},
        {"", with({"collectors.influence_radius=0.2", "collectors.radius_factor=2",
                   "collectors.accumulation=private"})},
        {"", with({"collectors.accumulation=shared", "collectors.light_refresh=3"})},
        {"", with({"collectors.scale=2", "collectors.upsample=linear"})},
        {"", with({"collectors.temporal=2", "collectors.upsample=nearest"})},
        {"", with({kWide})},
        {"", with({kWide, "sun.elevation_deg=90", "collectors.bands=2"})},
        {"", with({kFlat})},
        {"", with({"collectors.photons=0"})},
        {"", with({"medium.0.extinction_per_m=0"})},
        {"", with({"medium.0.extinction_per_m=30", "medium.0.emission=[0.1, 0.2, 0]"})},
        {"", with({"medium.0.resolution=[1,9,9]", "medium.0.density=uniform:box"})},
        {"", with({"sun.irradiance=[1, 0.5, 0.2]", "sun.elevation_deg=0.01"})},
        {kLamps, with({})},
        {kLamps, with({kFlat, "collectors.scale=2"})},
        {many_media(), with({})},
        {many_media(), with({"collectors.display=billboards", "collectors.closure=lobe"})},
        {kAir, with({})},
    };
}

inline std::vector<Row> grid_rows() {
    const std::string method = "method.name=photon-grid";
    const auto with = [&](Overrides more) {
        more.insert(more.begin(), method);
        return more;
    };
    return {
        {"", with({})},
        {"", with({"photon_grid.bands=1", "photon_grid.first_order_split=false"})},
        {"", with({"photon_grid.bands=8", "photon_grid.cells=[5,5,4]", "medium.0.albedo=1"})},
        {"", with({"photon_grid.axis_degrees=8", "photon_grid.peak_deg=20", kPeak})},
        {"", with({"photon_grid.closure=published"})},
        {"", with({"photon_grid.closure=mean", "photon_grid.tracking=global"})},
        {"", with({"photon_grid.closure=camera"})},
        {"", with({"photon_grid.closure=camera", "camera.projection=orthographic",
                   "camera.height_m=2000"})},
        {"", with({"photon_grid.directions=camera", "photon_grid.ring=true"})},
        {"", with({"photon_grid.ring=true", "photon_grid.light_refresh=3"})},
        {"", with({"photon_grid.accumulation=private", "photon_grid.scale=2"})},
        {"", with({"photon_grid.accumulation=shared", "photon_grid.temporal=2"})},
        {"", with({kWide})},
        {"", with({kWide, "sun.elevation_deg=90", "photon_grid.bands=2"})},
        {"", with({kFlat})},
        {"", with({"photon_grid.photons=0"})},
        {"", with({"medium.0.extinction_per_m=30", "medium.0.emission=0.1"})},
        {kLamps, with({})},
        {many_media(), with({})},
        {many_media(), with({"photon_grid.closure=published"})},
        {kAir, with({})},
    };
}

inline std::vector<Row> march_rows() {
    const auto with = [](const char* method, Overrides more) {
        more.insert(more.begin(), std::string("method.name=") + method);
        return more;
    };
    const auto march = [&](Overrides more) { return with("raymarch", std::move(more)); };
    const auto simple = [&](Overrides more) { return with("optical-depth", std::move(more)); };
    return {
        {"", march({})},
        {"", march({"raymarch.integrator=riemann", "raymarch.spacing=voxel"})},
        {"", march({"raymarch.integrator=closed", "raymarch.spacing=voxel", kFlat})},
        {"", march({"raymarch.integrator=trapezoid", "raymarch.spacing=optimal"})},
        {"", march({"raymarch.integrator=simpson", "raymarch.jitter=hash"})},
        {"", march({"raymarch.integrator=simpson38", "raymarch.jitter=blue-noise"})},
        {"", march({"raymarch.spacing=geometric", "raymarch.growth=1.2", "raymarch.first_step_m=20",
                    "raymarch.occlusion=stretch"})},
        {"", march({"raymarch.scattering=octaves", "raymarch.powder=powder"})},
        {"", march({"raymarch.scattering=octaves", "raymarch.sky_light=ambient",
                    "raymarch.powder=directional"})},
        {"", march({"raymarch.scattering=forward", "raymarch.powder=beer-powder",
                    "raymarch.cone_deg=20", kPeak})},
        {"", march({"raymarch.light=march", "raymarch.light_steps=3", "raymarch.light_growth=2",
                    "raymarch.light_first_step_m=30"})},
        {"", march({"raymarch.light=march", "raymarch.light_path=cone", "raymarch.light_steps=4"})},
        {"", march({"raymarch.light=march", "raymarch.light_steps=0", kFlat})},
        {"", march({"raymarch.light=march", "raymarch.light_steps=0", kWide})},
        {"", march({"raymarch.light=buffer", "raymarch.ambient=[0.1, 0.2, 0.3]"})},
        {"", march({"raymarch.light=buffer-exact", "raymarch.phase=peak"})},
        {"", march({"raymarch.light=buffer", kWide, "sun.elevation_deg=90"})},
        {"", march({"raymarch.light=buffer", "sun.elevation_deg=0.01"})},
        {"", march({"raymarch.steps=0"})},
        {"",
         march({"raymarch.detail=false", "raymarch.stop_below=0.5", "raymarch.grid_lock_m=100"})},
        {"", march({"raymarch.scale=2", "raymarch.upsample=linear", "raymarch.light_refresh=3"})},
        {"", march({"raymarch.temporal=2", "raymarch.upsample=nearest"})},
        {"",
         march({"camera.projection=orthographic", "camera.height_m=2000", "raymarch.temporal=2"})},
        {"", march({"medium.0.emission=[0.1, 0.2, 0]", "raymarch.scattering=octaves"})},
        {kLamps, march({"raymarch.scattering=octaves"})},
        {kLamps, march({kFlat, "raymarch.scale=2"})},
        {many_media(), march({"raymarch.sky_light=ambient", "raymarch.light=buffer"})},
        {many_media() + kLamps, march({"raymarch.scattering=octaves", "medium.3.emission=0.2"})},
        {kSkyInPlace, march({})},
        {kSkyInPlace, march({"raymarch.temporal=2", "raymarch.light=march"})},
        {kSkyInPlace, march({"medium.0.sky.planet_radius_m=0", "raymarch.light_steps=8"})},
        {kSkyInPlace, march({"medium.0.sky.blend=0", "medium.0.sky.wind_m_per_s=[10, 3]"})},
        {kBoxedSky, march({})},
        {kBoxedSky, march({"medium.0.sky.coverage=0"})},
        {kAir, march({})},
        {kAir, march({"camera.position_m=[0, 0, 3000]", "camera.target_m=[0, 4000, 3560]",
                      "camera.fov_deg=8"})},
        {"", simple({})},
        {"", simple({"optical_depth.ambient=[0.1, 0.2, 0.3]", "optical_depth.powder_strength=2",
                     "optical_depth.g=0.4"})},
        {"", simple({"optical_depth.powder_by=extinction", "optical_depth.powder_strength=2",
                     "optical_depth.buffer=exact"})},
        {"", simple({"optical_depth.light_scale=2", "optical_depth.resolution=[5,5,4]", kWide})},
        {"", simple({"optical_depth.max_extinction_per_m=0.01", kFlat})},
        {"", simple({"optical_depth.steps=0"})},
        {kLamps, simple({"optical_depth.stop_below=0.5"})},
        {many_media(), simple({})},
        {kAir, simple({})},
        // Wide enough for runs of pixels in the air that are alike.
        {kAir, simple({"camera.resolution=[70,4]", "atmosphere.sun_disc=false"})},
    };
}

inline std::vector<Row> other_rows() {
    const auto with = [](const char* method, Overrides more) {
        more.insert(more.begin(), std::string("method.name=") + method);
        return more;
    };
    const auto path = [&](Overrides more) { return with("path", std::move(more)); };
    const auto balls = [&](Overrides more) { return with("particles", std::move(more)); };
    return {
        {"", path({})},
        {"", path({"path.max_depth=2", "path.pixel=centre", "path.guide=false"})},
        {"", path({"path.guide=true", kPeak, "sun.angular_radius_deg=0.5"})},
        {"", path({"sun.angular_radius_deg=2", "medium.0.albedo=1"})},
        {"", path({"filter.kind=regression"})},
        {"",
         path({"filter.kind=regression", "filter.radius_pixels=2", "camera.resolution=[20,12]"})},
        {"", path({kWide})},
        {"", path({kFlat})},
        {"", path({kWide, "camera.projection=flux", "camera.height_m=600",
                   "camera.target_m=[16, -4000, 1024]", "camera.up=[0, 1, 0]"})},
        {"", path({"camera.projection=orthographic", "camera.height_m=2000"})},
        {"", path({"medium.0.emission=[0.1, 0.2, 0]"})},
        {kLamps, path({})},
        {kLamps, path({kPeak, "path.guide=true", "medium.0.emission=0.1"})},
        {kLamps, path({kFlat, "path.max_depth=3"})},
        {many_media(), path({})},
        {many_media() + kLamps, path({"medium.3.emission=0.2"})},
        {kAir, path({})},
        {kSpheres, balls({})},
        {kSpheres,
         balls({"particles.scattering=effective", "particles.cone_deg=30", "particles.bins=7"})},
        {kSpheres,
         balls({"particles.scattering=similarity", "particles.leaf=2", "particles.light=centre"})},
        {kSpheres, balls({"particles.scattering=octaves", "particles.sky_light=ambient",
                          "particles.light_bias=0.5"})},
        {kSpheres, balls({"particles.light=exact", "particles.most_depth=2"})},
        {kSpheres, balls({"particles.light=linear"})},
        {kSpheres, balls({"particles.occluders=0.5", "particles.shadow_density=2"})},
        {kSpheres, balls({"particles.sky_light=none", "particles.stop_below=0.5"})},
        {kSpheres, balls({"particles.display=billboards", "particles.falloff=3"})},
        {kSpheres, balls({"particles.display=billboards", "camera.aperture_radius_m=20",
                          "camera.focus_distance_m=1500"})},
        {kSpheres, balls({"particles.display=billboards", "camera.shutter_s=2",
                          "medium.0.density=procedural:plume", "medium.0.plume.particles=60",
                          "medium.0.bounds_m=[[-100,-100,600],[100,100,1000]]",
                          "medium.0.extinction_per_m=1", "particles.falloff=2.5"})},
        {kSpheres, balls({"particles.display=billboards", "camera.projection=orthographic",
                          "camera.height_m=800", "particles.display_scale=2"})},
        {std::string(kSpheres) + kLamps, balls({"particles.scattering=octaves"})},
        {std::string(kSpheres) + kLamps, balls({"particles.light=exact", "medium.0.emission=0.1"})},
        {std::string(kSpheres) + kLamps,
         balls({"particles.display=billboards", "medium.0.emission=0.1"})},
    };
}

}  // namespace settings_test
