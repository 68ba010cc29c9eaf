// SPDX-License-Identifier: Apache-2.0
// Every number between a METAR and its sky, each with its source; "chosen" where there is none.
// in: nothing -> out: constants. docs/metar.md has them for readers
#pragma once
#include "src/scene/metar/metar.h"

namespace pileus {

// Heights of the three floors of clouds, temperate zone: International Cloud Atlas (WMO 2017).
constexpr double kMetarMiddle_m = 2000, kMetarHigh_m = 5000;
// Below it broken cloud is stratus, and rags of cloud are no heaps: chosen.
constexpr double kMetarStratus_m = 400;
// An overcast that rains on is nimbostratus below this: Atlas, "base mostly below 3 km".
constexpr double kMetarNimbostratus_m = 3000;
// A reported height of 000 is below 30 m (Annex 3): its middle.
constexpr double kMetarLeastBase_m = 15;
// Where no height is reported: chosen.
constexpr double kMetarUnknownBase_m = 900;
// A sheet ends so far below the next one, and is at least so thick: chosen.
constexpr double kMetarGap_m = 30, kMetarLeastThickness_m = 100;

// Middles of the eighths that a word stands for: WMO No. 306, code table 0265 and 15.9.1.1.
constexpr double metar_coverage(MetarCover cover) {
    return cover == MetarCover::kFew        ? 1.5 / 8
           : cover == MetarCover::kBroken   ? 6.0 / 8
           : cover == MetarCover::kOvercast ? 1.0
                                            : 3.5 / 8;
}

/// A kind of sheet: `type` of [medium.sky], its thickness, and for type custom all else.
struct MetarSheet {
    const char* name;
    const char* type;
    double thickness_m;
    double extinction_per_m;  ///< 0: the type's
    const char* phase;        ///< "": the type's
    const char* shape;        ///< further keys of the table sky
};

// Thicknesses: heap clouds of small size 300 to 700 m, stratocumulus 200 to 500 m, stratus 300 m,
// nimbostratus 2 to 3 km, altostratus 1 to 2 km, cirrostratus 1 km (house's own types,
// docs/generators.md, docs/skies.md); those that differ are chosen.
// Extinction of altocumulus and ice, droplets of 8 um, g of ice 0.78: docs/generators.md. Shapes:
// chosen by eye.
constexpr const char* kMetarIce = "{ type = \"henyey-greenstein\", g = 0.78 }";
constexpr const char* kMetarMiddleDrops = "{ type = \"cloud\", effective_radius_um = 8 }";
constexpr const char* kMetarCells =
    "perlin_m = 9000, worley_m = 1800, blend = 0.5, threshold_low = 0.5, threshold_high = 0.68, "
    "base_rise = 0.3, top_fall = 0.5, rounding = 0.25, base_density = 0.5";
constexpr const char* kMetarVeil =
    "perlin_m = 30000, worley_m = 9000, blend = 1, threshold_low = 0.3, threshold_high = 1, "
    "base_rise = 0.4, top_fall = 0.4, rounding = 0.1, base_density = 0.5, size = 256, "
    "roughness = 0.6";
constexpr MetarSheet kMetarRags = {"stratus", "stratus", 150, 0, "", ""};
constexpr MetarSheet kMetarHumilis = {"cumulus", "cumulus", 400, 0, "", ""};
constexpr MetarSheet kMetarMediocris = {"cumulus", "cumulus", 700, 0, "", ""};
constexpr MetarSheet kMetarStratus = {"stratus", "stratus", 300, 0, "", ""};
constexpr MetarSheet kMetarStratocumulus = {"stratocumulus", "stratocumulus", 400, 0, "", ""};
constexpr MetarSheet kMetarNimbostratus = {"nimbostratus", "nimbostratus", 2500, 0.02, "", ""};
constexpr MetarSheet kMetarThunder = {"cumulonimbus", "cumulonimbus", 8000, 0.0125, "", ""};
constexpr MetarSheet kMetarTowering = {"cumulus", "cumulus", 3000, 0, "", ""};
constexpr MetarSheet kMetarAltocumulus = {"altocumulus", "custom",          200,
                                          0.03,          kMetarMiddleDrops, kMetarCells};
constexpr MetarSheet kMetarAltocumulusBroken = {"altocumulus", "custom",          300,
                                                0.03,          kMetarMiddleDrops, kMetarCells};
constexpr MetarSheet kMetarAltostratus = {"altostratus", "stratus",         1500,
                                          0.012,         kMetarMiddleDrops, ""};
constexpr MetarSheet kMetarCirrus = {"cirrus", "custom", 800, 0.0015, kMetarIce, kMetarVeil};
constexpr MetarSheet kMetarCirrostratus = {"cirrostratus", "custom",  900,
                                           0.0015,         kMetarIce, kMetarVeil};

/// A kind of tower by chance. Counts within the radius, distances: chosen for a sky that shows
/// some; a tower of the least distance stands clear of the camera.
struct MetarTowers {
    const char* name;
    const char* type;          ///< of [medium.cloud]
    int few, scattered, most;  ///< of a group, and of all groups
    double near_m, max_far_m;
    double room_m;  ///< ring beyond near_m in which all of them have room; a narrower one takes one
};
constexpr MetarTowers kMetarCumulonimbus = {"cumulonimbus", "cumulonimbus", 1, 2, 3, 15000, 1e6,
                                            20000};
constexpr MetarTowers kMetarCongestus = {"congestus", "cumulus-congestus", 12, 24, 24, 3000, 25000,
                                         12000};

// So many congestus beside cumulonimbi, whose boxes leave little room: tried with 60 seeds.
constexpr int kMetarCongestusBeside = 4;

// Wind: that of the ground times 1 + h/1 km up to 2 at 1 km, the top of the layer of friction, and
// 0.1 more for each further km; turned by up to 25 degrees at 1 km, to the right in the north.
// Chosen within what winds over land do (Stull 1988, chapter 6: half, and 20 to 40 degrees).
constexpr double kMetarFriction_m = 1000, kMetarWindGain = 1, kMetarWindGainPerKm = 0.1;
constexpr double kMetarVeer_deg = 25;

// Koschmieder 1924, contrast 0.02: visibility = 3.912 / extinction.
constexpr double kMetarKoschmieder = 3.912;
// docs/atmosphere.md: depth 0.0972 (turbidity - 1) over a scale height of 1.2 km.
constexpr double kMetarHaze_per_m = 0.0972 / 1200;
constexpr double kMetarClearTurbidity = 2;  // docs/atmosphere.md, "clear": of 10 km and more
constexpr double kMetarLeastTurbidity = 1.5, kMetarMostTurbidity = 10;
constexpr double kMetarUnknownFog_m = 500;    // visibility in fog where none is reported: chosen
constexpr double kMetarPatchFog_m = 600;      // within patches: below 1000 m (Annex 3), chosen
constexpr double kMetarUnknownSight_m = 60;   // upwards, of VV///: chosen
constexpr double kMetarThickest_per_m = 0.1;  // dense fog: 40 m of visibility, chosen

/// What dims the view at the ground. Turbidity is that of the air besides.
struct MetarDimming {
    const char* code;
    const char* name;
    double turbidity;
    double thickness_m;
    const char* albedo;
    const char* phase;
};
// Fog 150 m: the house's type. Other thicknesses, turbidities and colours: chosen; single
// scattering by haze as docs/atmosphere.md has it, by smoke and dust within OPAC (Hess et al.
// 1998; soot mixtures 0.86, mineral 0.97 falling towards blue).
constexpr const char* kMetarFogDrops = "{ type = \"cloud\", cloud = \"fog\" }";
constexpr const char* kMetarHazePhase = "{ type = \"henyey-greenstein\", g = 0.72 }";
constexpr MetarDimming kMetarDimmings[] = {
    {"FG", "fog", 2, 150, "1", kMetarFogDrops},
    {"BR", "mist", 4, 300, "1", kMetarFogDrops},
    {"HZ", "haze", 10, 1500, "0.93", kMetarHazePhase},
    {"FU", "smoke", 10, 1500, "[0.86, 0.85, 0.83]", kMetarHazePhase},
    {"DU", "dust", 10, 2000, "[0.97, 0.93, 0.85]", kMetarHazePhase},
    {"SA", "sand", 10, 1000, "[0.97, 0.93, 0.85]", kMetarHazePhase},
    {"DS", "dust", 10, 2000, "[0.97, 0.93, 0.85]", kMetarHazePhase},
    {"SS", "sand", 10, 1000, "[0.97, 0.93, 0.85]", kMetarHazePhase},
    {"VA", "ash", 10, 2000, "[0.92, 0.91, 0.90]", kMetarHazePhase},
    {"SN", "blowing_snow", 2, 100, "1", "{ type = \"henyey-greenstein\", g = 0.85 }"},
};

/// What falls. Extinction: of drops factor * R^0.63 per km of R mm/h, of snow by the visibility
/// that FMH-1 (12.6.8, table 12-2) defines light, moderate and heavy by.
struct MetarFall {
    const char* code;
    const char* name;
    double per_km[3];  ///< light, moderate, heavy
    double g;
};
// Rain: 0.365 R^0.63 (Marshall and Palmer 1948, docs/generators.md) at 1, 5 and 20 mm/h, within the
// bounds 2.5 and 10 mm/h of WMO No. 8. Drizzle: 0.509 R^0.63 (drops of Joss, Thams and Waldvogel
// 1968) at 0.1, 0.3, 0.8 mm/h. Snow: 3.912 / 1.5, 0.6, 0.3 km. Grains and crystals: a third and a
// tenth of snow, chosen. Ice pellets and hail as rain, chosen. g: drops 0.9, the sharpest that all
// methods take; snow 0.85; chosen. Albedo 1: absorption in the visible is below 1e-3.
constexpr MetarFall kMetarFalls[] = {
    {"SN", "snow", {2.6, 6.5, 13.0}, 0.85},     {"RA", "rain", {0.365, 1.006, 2.41}, 0.9},
    {"DZ", "rain", {0.119, 0.238, 0.442}, 0.9}, {"SG", "snow", {0.87, 2.2, 4.3}, 0.85},
    {"PL", "rain", {0.365, 1.006, 2.41}, 0.9},  {"GR", "rain", {0.365, 1.006, 2.41}, 0.9},
    {"GS", "rain", {0.365, 1.006, 2.41}, 0.9},  {"UP", "rain", {0.365, 1.006, 2.41}, 0.9},
    {"IC", "snow", {0.26, 0.65, 1.3}, 0.85},
};
// Share of the ground under shafts: chosen. Where it rains on, shafts are only denser streaks.
constexpr double kMetarShaftCoverage[3] = {0.25, 0.4, 0.6};
constexpr double kMetarFallTop_m = 1500;  // where no cloud is reported: chosen

// Steps of a ray, and one pixel of so many by so many a frame: docs/realtime.md.
constexpr int kMetarSteps = 96, kMetarTemporal = 4;
// Of sheets of ice, which are thin and even.
constexpr double kMetarThin_m = 5000;
constexpr int kMetarThinSteps = 32;

}  // namespace pileus
