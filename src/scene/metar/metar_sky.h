// SPDX-License-Identifier: Apache-2.0
// The sky that a METAR describes, as scenes of pileus: sheets of cloud, fog and precipitation,
// towers by chance, the air's turbidity.
// in: a report, a seed, the aerodrome's height -> out: texts of scenes, numbers, and what was
// assumed. Sources of every number: metar_table.h. docs/metar.md
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "src/scene/metar/metar.h"

namespace pileus {

struct MetarSkySettings {
    std::int64_t seed = 0;         ///< another one, other clouds of the same report
    double field_elevation_m = 0;  ///< of the aerodrome: heights of the report count from there
    double scale_radius_km = 40;   ///< how far towers are strewn
    bool southern = false;         ///< south of the equator, where winds back with height
};

/// A whole scene of one medium with its method. Its camera is there because a scene must have one.
struct MetarScene {
    std::string name;  ///< as "stratocumulus_2"; unlike those of the others
    std::string text;  ///< TOML
};

/// A row of [[clouds.scatter]] over one of the kinds.
struct MetarScatter {
    std::string kind;
    int count = 0;
    double base_m = 0, near_m = 0, far_m = 0;
    std::int64_t seed = 0;
};

struct MetarSky {
    std::vector<MetarScene> layers;  ///< clouds from the lowest up, then what begins at the ground
    std::vector<MetarScene> kinds;   ///< clouds of [[clouds.kind]]
    std::vector<MetarScatter> scatter;
    double turbidity = 2;  ///< of [atmosphere]
    bool time_given = false;
    int day = 0;                     ///< of a month that the report does not tell
    double utc_hours = 0;            ///< 0 to 24
    std::vector<std::string> notes;  ///< a line for each thing that was assumed or left out
};

/// Errors: kBadInput in one line for a setting out of range. `out` is changed only on success.
Status metar_sky(const Metar& report, const MetarSkySettings& settings, MetarSky& out);

}  // namespace pileus
