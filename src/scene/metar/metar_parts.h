// SPDX-License-Identifier: Apache-2.0
// The parts that a sky out of a METAR is put together from.
// in: a report and the sky so far -> out: further layers, kinds, notes. docs/metar.md
#pragma once
#include "src/scene/metar/metar_sky.h"
#include "src/scene/metar/metar_table.h"

namespace pileus {

/// One medium of "procedural:sky" before it is text; altitudes are those of the scene.
struct MetarMedium {
    std::string name, type;
    double base_m = 0, top_m = 0;
    double coverage = -1;         ///< below 0: by thresholds of `shape`
    double extinction_per_m = 0;  ///< 0: the type's
    std::string albedo;           ///< "": 1
    std::string phase;            ///< "": the type's
    std::string shape;            ///< further keys of the table sky
};

/// What all parts read and add to.
struct MetarDraft {
    const Metar& report;
    const MetarSkySettings& settings;
    MetarSky& sky;
    /// Heights above the aerodrome of the lowest ceiling or tower, and of the lowest cloud; below
    /// 0: none. Set by add_metar_clouds.
    double lowest_ceiling_m = -1, lowest_m = -1;

    void note(const std::string& text) { sky.notes.push_back(text); }
    /// Adds a medium as a scene, with the wind at its base.
    void add(const MetarMedium& medium);
    /// Adds a kind of tower, once, and a row of places.
    void add_towers(const MetarTowers& towers, bool few, int count, double base_m);
    std::int64_t next_seed();
    std::uint64_t seeds = 0;
};

/// Towards east and north, at a height above the aerodrome.
void metar_wind_at(const Metar& report, bool southern, double height_m, double (&m_per_s)[2]);

void add_metar_clouds(MetarDraft& draft);
/// Fog, haze, precipitation and the turbidity, by the visibility and the weather.
void add_metar_air(MetarDraft& draft);

/// Whether something falls without showers or thunder: the sign of nimbostratus.
bool metar_rains_on(const Metar& report);

}  // namespace pileus
