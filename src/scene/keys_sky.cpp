// SPDX-License-Identifier: Apache-2.0
// Rows of the key table for procedural skies.
// in: checked TOML values -> out: fields of SkySettings.
// docs/skies.md; Palenik 2016, section 5.1 "Shader parameters".
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

constexpr KeyRange kShare{0, 1, false, false};
constexpr KeyRange kMetres{0, 1e9, true, false};
constexpr KeyRange kAltitude{-1e6, 1e9, false, false};
constexpr KeyRange kNoiseValue{-4, 5, false, false};
constexpr KeyRange kGain{0, 100, false, false};

SkyEvaluation evaluation(const std::string& name) {
    if (name == "grid") return SkyEvaluation::kGrid;
    return name == "direct" ? SkyEvaluation::kDirect : SkyEvaluation::kAuto;
}

const KeyRow kRows[] = {
    {"medium.N.sky.type",
     KeyKind::kText,
     "",
     "\"custom\"",
     {},
     kSkyTypes,
     nullptr,
     "kind of cloud: sets what is left out of this table, and extinction and phase function where "
     "these are left out (docs/skies.md)",
     [](const Node& n, KeyTarget t) { t.medium.sky.type = n.text; }},
    range_key(KeyKind::kNumber, "medium.N.sky.perlin_m", "m", "", kMetres,
              "length after which the Perlin noise repeats",
              [](const Node& n, KeyTarget t) { t.medium.sky.perlin.tile_m = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.worley_m", "m", "", kMetres,
              "length after which the Worley noise repeats",
              [](const Node& n, KeyTarget t) { t.medium.sky.worley.tile_m = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.scale", "", "1", {0, 1e6, true, false},
              "factor on both lengths",
              [](const Node& n, KeyTarget t) { t.medium.sky.scale = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.blend", "", "", kShare,
              "1: Perlin noise alone, 0: Worley noise alone",
              [](const Node& n, KeyTarget t) { t.medium.sky.blend = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.gain_perlin", "", "1", kGain,
              "factor on the Perlin noise",
              [](const Node& n, KeyTarget t) { t.medium.sky.perlin.gain = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.gain_worley", "", "1", kGain,
              "factor on the Worley noise",
              [](const Node& n, KeyTarget t) { t.medium.sky.worley.gain = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.threshold_low", "", "", kNoiseValue,
              "noise below it is no cloud (Palenik's A); the noise has mean 0.5 and deviation "
              "1/7 before blending",
              [](const Node& n, KeyTarget t) { t.medium.sky.threshold_low = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.threshold_high", "", "", kNoiseValue,
              "noise above it has density 1 (Palenik's B)",
              [](const Node& n, KeyTarget t) { t.medium.sky.threshold_high = number_of(n); }),
    range_key(
        KeyKind::kNumber, "medium.N.sky.coverage", "", "", kShare,
        "share of the sky that clouds cover, seen straight up: moves both thresholds; 0 is no "
        "cloud at all; left out for custom, or with a threshold given: they stay",
        [](const Node& n, KeyTarget t) { t.medium.sky.coverage = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.density", "", "1", {0, 1e9, false, false},
              "factor on the extinction",
              [](const Node& n, KeyTarget t) { t.medium.sky.density = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.base_m", "m", "", kAltitude,
              "altitude of the layer's base",
              [](const Node& n, KeyTarget t) { t.medium.sky.base_m = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.top_m", "m", "", kAltitude,
              "altitude of the layer's top",
              [](const Node& n, KeyTarget t) { t.medium.sky.top_m = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.base_rise", "", "", kShare,
              "share of the thickness over which clouds widen above the base",
              [](const Node& n, KeyTarget t) { t.medium.sky.base_rise = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.top_fall", "", "", kShare,
              "share of the thickness over which clouds narrow below the top",
              [](const Node& n, KeyTarget t) { t.medium.sky.top_fall = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.rounding", "", "", {0, 10, false, false},
              "how much the noise is lowered at base and top; 0: the layer cuts clouds off",
              [](const Node& n, KeyTarget t) { t.medium.sky.rounding = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.base_density", "", "", kShare,
              "density at the base over that at the top, linear between",
              [](const Node& n, KeyTarget t) { t.medium.sky.base_density = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.planet_radius_m", "m", "0", {0, 1e12, false, false},
              "bends the layer around a planet below the origin, for the Earth 6.371e6; 0: flat",
              [](const Node& n, KeyTarget t) { t.medium.sky.planet_radius_m = number_of(n); }),
    range_key(KeyKind::kNumber2, "medium.N.sky.wind_m_per_s", "m/s", "[0, 0]",
              {-1000, 1000, false, false}, "speed of the clouds towards east and north",
              [](const Node& n, KeyTarget t) { t.medium.sky.wind_m_per_s = number2_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.sky.time_s", "s", "0", {-1e12, 1e12, false, false},
              "how long the wind has blown",
              [](const Node& n, KeyTarget t) { t.medium.sky.time_s = number_of(n); }),
    range_key(KeyKind::kInteger, "medium.N.sky.seed", "", "0", {0, 0x1p32, false, true},
              "another sky for each number",
              [](const Node& n, KeyTarget t) { t.medium.sky.seed = integer_of(n); }),
    range_key(KeyKind::kInteger, "medium.N.sky.size", "texels", "128", {16, 512, false, false},
              "texels along each noise's tile: a power of two",
              [](const Node& n, KeyTarget t) { t.medium.sky.size = int(integer_of(n)); }),
    range_key(KeyKind::kInteger, "medium.N.sky.perlin_cells", "", "4", {1, 256, false, false},
              "coarsest lumps of the Perlin noise along its tile",
              [](const Node& n, KeyTarget t) { t.medium.sky.perlin.cells = int(integer_of(n)); }),
    range_key(KeyKind::kInteger, "medium.N.sky.worley_cells", "", "4", {1, 256, false, false},
              "coarsest lumps of the Worley noise along its tile",
              [](const Node& n, KeyTarget t) { t.medium.sky.worley.cells = int(integer_of(n)); }),
    range_key(KeyKind::kInteger, "medium.N.sky.octaves", "", "0", {0, 10, false, false},
              "octaves of both noises; 0: down to four texels per lump",
              [](const Node& n, KeyTarget t) {
                  t.medium.sky.perlin.octaves = t.medium.sky.worley.octaves = int(integer_of(n));
              }),
    range_key(KeyKind::kNumber, "medium.N.sky.roughness", "", "0.5", kShare,
              "size of an octave over that of the next coarser one",
              [](const Node& n, KeyTarget t) { t.medium.sky.roughness = number_of(n); }),
    choice_key(KeyKind::kText, "medium.N.sky.evaluate", "\"auto\"", "auto|grid|direct", nullptr,
               "`grid`: densities of `resolution` cells in the box; `direct`: the noise itself, by "
               "`raymarch` alone; `auto`: direct where that can be",
               [](const Node& n, KeyTarget t) { t.medium.sky.evaluate = evaluation(n.text); }),
};

}  // namespace

Span<const KeyRow> sky_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
