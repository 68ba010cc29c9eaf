// SPDX-License-Identifier: Apache-2.0
// Keys of what surrounds the cloud: seed, camera, sun, sky, ground, clear air.
// in: checked values <-> out: fields of Scene, Camera, Sun, Sky, Ground, AtmosphereSettings.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField camera = field<&Scene::camera, Members...>;
template <auto... Members>
constexpr KeyField view_files = field<&Scene::view_files, Members...>;
template <auto... Members>
constexpr KeyField lens = field<&Scene::lens, Members...>;
template <auto... Members>
constexpr KeyField sun = field<&Scene::sun, Members...>;
template <auto... Members>
constexpr KeyField sky = field<&Scene::sky, Members...>;
template <auto... Members>
constexpr KeyField ground = field<&Scene::ground, Members...>;
template <auto... Members>
constexpr KeyField surface = field<&Scene::surface, Members...>;
using Surface = GroundSurface;

/// Two flags: parallel rays, and none at all.
constexpr KeyField kProjection{
    KeyKind::kChoice,
    [](const KeySource& s) {
        return node_of(s.scene.camera.flux ? 2 : int(s.scene.camera.orthographic));
    },
    [](const KeyTarget& t, const Node& n) {
        t.scene.camera.orthographic = n.integer > 0;
        t.scene.camera.flux = n.integer == 2;
    }};

/// A place by the map of the weather data.
template <Double3 ViewFiles::*kPlace, bool ViewFiles::*kByPlace>
constexpr KeyField place{KeyKind::kNumber3,
                         [](const KeySource& s) {
                             const ViewFiles& v = s.scene.view_files;
                             return v.*kByPlace ? node_of(v.*kPlace) : no_value();
                         },
                         [](const KeyTarget& t, const Node& n) {
                             t.scene.view_files.*kByPlace = true;
                             take(n, t.scene.view_files.*kPlace);
                         }};

constexpr KeyRow kRows[] = {
    {"seed", field<&Scene::seed>, from_to(0, 0x1p63), "",
     "chooses the random numbers; the same seed gives the same picture, bit for bit"},
    {"camera.position_m", camera<&Camera::position_m>, ranged(&Camera::position_m), "m",
     "where the camera stands; x to the east, y to the north, z up", kRequired},
    {"camera.target_m", camera<&Camera::target_m>, ranged(&Camera::target_m), "m",
     "a point in the middle of the picture; not the position", kRequired},
    {"camera.up", camera<&Camera::up>, ranged(&Camera::up), "",
     "a direction that points up in the picture; not along the view"},
    {"camera.projection", kProjection, one_of("perspective|orthographic|flux"), "",
     "how space is mapped to the picture; `flux`, method `path` only: pixels tile a flat "
     "detector through position_m that faces target_m, and show its irradiance"},
    {"camera.fov_deg", camera<&Camera::fov_deg>, ranged(&Camera::fov_deg), "deg",
     "vertical field of view; perspective only"},
    {"camera.height_m", camera<&Camera::height_m>, ranged(&Camera::height_m), "m",
     "height of the picture in space; orthographic and flux only"},
    {"camera.resolution", camera<&Camera::resolution>, ranged(&Camera::resolution), "pixels",
     "width and height of the picture"},
    {"camera.crop", field<&Scene::crop>, from_to(0, 32768), "pixels",
     "x0, y0, x1, y1: only these pixels of the picture, ends exclusive, with the bits that they "
     "have "
     "in all of it; left out: all",
     kNoNote},
    {"camera.depth", view_files<&ViewFiles::depth>, any(), "",
     "image of the distance to solid things, .exr (channel Z, or its only one) or grey .pfm, of "
     "the picture's size; what lies behind is left out, and black",
     kNoNote},
    {"camera.depth_kind", view_files<&ViewFiles::depth_on_axis>, one_of("distance|z"), "",
     "its values: along each pixel's ray, or along the view's axis"},
    {"camera.depth_scale", view_files<&ViewFiles::depth_scale>, positive(1e9), "m",
     "metres per unit of its values"},
    {"camera.aperture_radius_m", lens<&Lens::aperture_radius_m>, from_to(0, 1e6), "m",
     "of a thin lens: depth of field; billboards of method `particles` only. 0: a pinhole"},
    {"camera.focus_distance_m", lens<&Lens::focus_distance_m>, positive(1e9), "m",
     "from the camera along the view to what is sharp; left out: the target", kNoNote},
    {"camera.shutter_s", lens<&Lens::shutter_s>, from_to(0, 1e6), "s",
     "how long the shutter is open, the picture's time in the middle: motion blur of particles "
     "with velocities; billboards of method `particles` only"},
    {"camera.position_deg", place<&ViewFiles::position_place, &ViewFiles::position_by_place>,
     from_to(-1e9, 1e9), "deg, deg, m",
     "instead of position_m: longitude, latitude and height by the map of the first medium that is "
     "weather data",
     kNoNote},
    {"camera.target_deg", place<&ViewFiles::target_place, &ViewFiles::target_by_place>,
     from_to(-1e9, 1e9), "deg, deg, m", "the same instead of target_m", kNoNote},
    {"sun.azimuth_deg", sun<&Sun::azimuth_deg>, ranged(&Sun::azimuth_deg), "deg",
     "where the sun stands, from north (+y) towards east (+x)"},
    {"sun.elevation_deg", sun<&Sun::elevation_deg>, ranged(&Sun::elevation_deg), "deg",
     "how high the sun stands over the horizon"},
    {"sun.irradiance", sun<&Sun::irradiance>, ranged(&Sun::irradiance), "any",
     "on a plane facing the sun; radiances come out in its unit"},
    {"sun.angular_radius_deg", sun<&Sun::angular_radius_deg>, from_to(0, 10), "deg",
     "of the sun's disc, which is alike all over; method `path` only, the others take a point. 0: "
     "a point; the real sun: 0.2665"},
    {"sky.radiance", sky<&Sky::radiance>, ranged(&Sky::radiance), "sun's per sr",
     "of a constant sky: the full sphere, or the upper half where there is a ground"},
    {"sky.map", view_files<&ViewFiles::sky_map>, any(), "",
     "latitude-longitude image of the sky's radiance, .exr or .pfm, in place of radiance; "
     "relative to the scene file, `${PILEUS_DATA_DIR}` may stand at its front",
     kNoNote},
    {"sky.map_scale", sky<&Sky::map_scale>, ranged(&Sky::map_scale), "",
     "factor on the map's values"},
    {"sky.map_rotation_deg", sky<&Sky::map_rotation_deg>, ranged(&Sky::map_rotation_deg), "deg",
     "turns the map about the vertical, from north towards east; at 0 its middle column "
     "stands in the north (+y)"},
    {"sky.model", KeyKind::kLater, any(), "", "a computed sky is the table [atmosphere]", kNoNote},
    {"ground.altitude_m", ground<&Ground::altitude_m>, ranged(&Ground::altitude_m), "m",
     "height of the level ground; every medium and the camera stand above it"},
    {"ground.albedo", ground<&Ground::albedo>, ranged(&Ground::albedo), "",
     "share of the light that the ground sends back, alike in all directions; of a sea what comes "
     "out of the water, 0.022 where it is left out"},
    {"ground.colour", surface<&Surface::colour>, from_to(0, 1000), "",
     "albedo by channel over ground.albedo; of a sea, where it is left out, [0.2, 0.8, 2]"},
    {"ground.surface", surface<&Surface::sea>, one_of("land|sea"), "",
     "sea: waves of sea_wind_m_s that reflect sun, sky and clouds; methods `path` and `raymarch`"},
    {"ground.sea_wind_m_s", surface<&Surface::wind_m_s>, from_to(0, 30), "m/s",
     "wind at 12 m over the sea, which roughens it"},
    {"ground.sea_wind_from_deg", surface<&Surface::wind_from_deg>, from_to(-360, 360), "deg",
     "where that wind comes from, from north towards east: its waves run the other way"},
    {"ground.map", surface<&Surface::map>, any(), "",
     "image of the ground's albedo, north up: .png .exr or .pfm, numbers in [0, 1]; relative to "
     "the "
     "scene file, `${PILEUS_DATA_DIR}` may stand at its front. Beyond it ground.albedo",
     kNoNote},
    {"ground.map_low_m", surface<&Surface::map_low_m>, from_to(-1e9, 1e9), "m",
     "x and y of the map's south-west corner"},
    {"ground.map_size_m", surface<&Surface::map_size_m>, positive(1e9), "m",
     "how far the map reaches from there, east and north; must be given with a map", kNoNote},
    {"ground.map_repeats", surface<&Surface::map_repeats>, any(), "",
     "whether the map begins again beyond its edges"},
};

template <auto Member>
constexpr KeyField air = field<&Scene::atmosphere, Member>;
using Air = AtmosphereSettings;

constexpr KeyRow kAirRows[] = {
    {"atmosphere.date", air<&Air::date>, moment_text(), "",
     "year-month-day, 1900 to 2100, as \"2026-06-21\": places the sun; left out: [sun] does",
     kNoNote},
    {"atmosphere.time", air<&Air::time>, moment_text(), "",
     "hours:minutes or hours:minutes:seconds of a clock at utc_offset_h"},
    {"atmosphere.utc_offset_h", air<&Air::utc_offset_h>, from_to(-14, 14), "h",
     "how far that clock is ahead of universal time; summer time is not known"},
    {"atmosphere.latitude_deg", air<&Air::latitude_deg>, from_to(-90, 90), "deg",
     "of the scene, north above 0; must be given with a date", kNoNote},
    {"atmosphere.longitude_deg", air<&Air::longitude_deg>, from_to(-180, 180), "deg",
     "of the scene, east above 0; must be given with a date", kNoNote},
    {"atmosphere.turbidity", air<&Air::turbidity>, from_to(1, 10), "",
     "optical depth of air and haze over that of air alone: 1 none, 2 clear, 4 hazy"},
    {"atmosphere.ground_albedo", air<&Air::ground_albedo>, from_to(0, 1), "",
     "of the round earth, where there is no [ground]"},
    {"atmosphere.refraction", air<&Air::refraction>, any(), "",
     "whether the air lifts the sun of a date near the horizon"},
    {"atmosphere.sun_disc", air<&Air::sun_disc>, any(), "",
     "whether the sun itself is seen in the sky; of sun.angular_radius_deg, or 0.2665 degrees"},
    {"atmosphere.moon", air<&Air::moon>, any(), "",
     "whether the moon of the date is seen, and lights the scene where the sun does not; needs a "
     "date"},
    {"atmosphere.stars", air<&Air::stars>, any(), "",
     "whether the stars of the date are seen, and their light is part of the sky; needs a date"},
    {"atmosphere.airglow", air<&Air::airglow>, any(), "",
     "whether the air's own faint light, and zodiacal light, are part of the sky"},
};

}  // namespace

Span<const KeyRow> atmosphere_keys() { return {kAirRows, sizeof kAirRows / sizeof kAirRows[0]}; }
Span<const KeyRow> view_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
