// SPDX-License-Identifier: Apache-2.0
// Keys of lights besides sun and sky.
// in: checked values <-> out: fields of LightSettings.
// docs/scene.md; docs/lights.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

constexpr KeyRow kRows[] = {
    {"light.N.type", field<&LightSettings::type>, one_of("point|spot|directional"), "",
     "a point that shines alike everywhere, a cone, or parallel light (docs/lights.md)", kRequired},
    {"light.N.position_m", field<&LightSettings::position_m>, from_to(-1e9, 1e9), "m",
     "where a point or spot light stands: inside the medium or outside; must be given", kNoNote},
    {"light.N.intensity", field<&LightSettings::intensity>, from_to(0, 1e18), "",
     "radiant intensity of a point or spot light, in the sun's unit times m^2 per sr: its "
     "irradiance at distance d is intensity / d^2"},
    {"light.N.radius_m", field<&LightSettings::radius_m>, from_to(0, 1e9), "m",
     "a point or spot light is a sphere of this radius, with soft shadows and no light inside; 0: "
     "a "
     "point, within a thousandth of a cell's shortest edge no brighter than there"},
    {"light.N.shadow_samples", field<&LightSettings::shadow_samples>, from_to(1, 64), "",
     "places on the sphere that methods other than path look at; 1: shadows of a point, also by "
     "path, and the irradiance within radius_m is intensity / radius_m^2"},
    {"light.N.direction", field<&LightSettings::direction>, from_to(-1e9, 1e9), "",
     "where a spot light shines, of any length but 0", kNoNote},
    {"light.N.target_m", field<&LightSettings::target_m>, from_to(-1e9, 1e9), "m",
     "instead of direction: the point that a spot light shines at", kNoNote},
    {"light.N.cone_deg", field<&LightSettings::cone_deg>, positive(360), "deg",
     "whole angle of a spot light's cone, from edge to edge"},
    {"light.N.penumbra_deg", field<&LightSettings::penumbra_deg>, from_to(0, 180), "deg",
     "width of the soft edge inside a spot light's cone, at most half of cone_deg"},
    {"light.N.azimuth_deg", field<&LightSettings::azimuth_deg>, from_to(-360, 360), "deg",
     "directional: where it stands, from +y (north) towards +x (east)"},
    {"light.N.elevation_deg", field<&LightSettings::elevation_deg>, from_to(-90, 90), "deg",
     "directional: angle above the horizon"},
    {"light.N.irradiance", field<&LightSettings::irradiance>, from_to(0, 1e9), "",
     "directional: on a plane facing it, in the sun's unit"},
};

}  // namespace

Span<const KeyRow> light_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
