// SPDX-License-Identifier: Apache-2.0
// A procedural cloud as a scene asks for it: a type, and what differs from the type.
// in: keys of medium.cloud -> out: plain values; those left out are the type's.
// docs/generators.md
#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace pileus {

/// What a number holds that is left out: then the type says it, or the box.
constexpr double kOfType = -1e30;
constexpr std::int64_t kCountOfType = -1000000;

struct CloudSettings {
    std::string type = "cumulus-mediocris";
    std::int64_t seed = 1;
    double height_m = kOfType;                           ///< of the tallest top over the base
    double radius_m = kOfType;                           ///< half the width of the foot
    double base_m = kOfType;                             ///< altitude of the condensation level
    std::array<double, 2> position_m{kOfType, kOfType};  ///< of the foot's middle
    std::int64_t turrets = kCountOfType;                 ///< in all
    std::int64_t tall = kCountOfType;                    ///< of nearly the full height
    double slimness = kOfType;                           ///< radius of a turret over its height
    double dilution = kOfType;                           ///< dry air mixed in at the edge, share
    double entrainment_per_km = kOfType;  ///< air taken in on the way up, share per km
    double age = kOfType;                 ///< 0: growing, 1: fallen apart
    double age_s = kOfType;               ///< since its first turret rose; left out: full-grown
    double lifetime_s = kOfType;          ///< until it is gone
    double outline = kOfType;             ///< bends of the outline in plan over radius_m
    double shear = kOfType;               ///< drift of the top over its height
    double wind_deg = 0;                  ///< where the top drifts to, from east towards north
    double turn_deg = 0;                  ///< that the wind veers from the base to the top
    double anvil = kOfType;               ///< radius of an anvil over the height; 0: none
    std::int64_t plates = kCountOfType;   ///< stacked lenses
    double cell_m = kOfType;              ///< width of a layer's cells
    double cover = kOfType;               ///< share of the ground under cloud, of fields and layers
    double erosion = 0.2;                 ///< share of its cell that an octave takes off
    double mamma = 0;                     ///< pouches under an anvil: share of their full depth
    double shelf = 0;                     ///< lip and shreds under the base: share of the full
    double rain = 0;                      ///< below the base, share of 50 mm/h; 0: none

    bool lives() const { return age_s != kOfType; }
    bool rains() const { return rain > 0; }
    bool has_place() const { return position_m[0] != kOfType; }
};

}  // namespace pileus
