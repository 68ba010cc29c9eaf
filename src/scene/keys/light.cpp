// SPDX-License-Identifier: Apache-2.0
// Keys of lights besides sun and sky.
// in: checked values <-> out: fields of LightSettings.
// docs/scene.md; docs/lights.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

using L = LightSettings;

constexpr KeyRow kRows[] = {
    {"light.N.type", field<&L::type>, one_of("point|spot|directional"), "",
     "a point that shines alike everywhere, a cone, or parallel light (docs/lights.md)", kRequired},
    {"light.N.position_m", field<&L::position_m>, ranged(&L::position_m), "m",
     "where a point or spot light stands: inside the medium or outside; must be given", kNoNote},
    {"light.N.intensity", field<&L::intensity>, ranged(&L::intensity), "",
     "radiant intensity of a point or spot light, in the sun's unit times m^2 per sr: its "
     "irradiance at distance d is intensity / d^2"},
    {"light.N.radius_m", field<&L::radius_m>, ranged(&L::radius_m), "m",
     "a point or spot light is a sphere of this radius, with soft shadows and no light inside; 0: "
     "a "
     "point, within a thousandth of a cell's shortest edge no brighter than there"},
    {"light.N.shadow_samples", field<&L::shadow_samples>, ranged(&L::shadow_samples), "",
     "places on the sphere that methods other than path look at; 1: shadows of a point, also by "
     "path, and the irradiance within radius_m is intensity / radius_m^2"},
    {"light.N.direction", field<&L::direction>, ranged(&L::direction), "",
     "where a spot light shines, of any length but 0", kNoNote},
    {"light.N.target_m", field<&L::target_m>, ranged(&L::target_m), "m",
     "instead of direction: the point that a spot light shines at", kNoNote},
    {"light.N.cone_deg", field<&L::cone_deg>, ranged(&L::cone_deg), "deg",
     "whole angle of a spot light's cone, from edge to edge"},
    {"light.N.penumbra_deg", field<&L::penumbra_deg>, ranged(&L::penumbra_deg), "deg",
     "width of the soft edge inside a spot light's cone, at most half of cone_deg"},
    {"light.N.azimuth_deg", field<&L::azimuth_deg>, ranged(&L::azimuth_deg), "deg",
     "directional: where it stands, from +y (north) towards +x (east)"},
    {"light.N.elevation_deg", field<&L::elevation_deg>, ranged(&L::elevation_deg), "deg",
     "directional: angle above the horizon"},
    {"light.N.irradiance", field<&L::irradiance>, ranged(&L::irradiance), "",
     "directional: on a plane facing it, in the sun's unit"},
};

}  // namespace

Span<const KeyRow> light_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
