// SPDX-License-Identifier: Apache-2.0
// A procedural sky as a scene asks for it: two noises, thresholds, a layer, wind.
// in: keys of medium.sky -> out: plain values; what a kind of cloud brings is filled in.
// docs/skies.md; Palenik 2016, section 5.1.
#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace pileus {

/// One of the two noises.
struct SkyNoise {
    double tile_m = 0;  ///< after which it repeats
    double gain = 1;
    int cells = 4;    ///< coarsest lumps along a tile
    int octaves = 0;  ///< 0: as many as the texels show
};

enum class SkyEvaluation { kAuto, kGrid, kDirect };

struct SkySettings {
    std::string type = "custom";
    SkyNoise perlin, worley;
    double scale = 1;  ///< of both tiles
    double blend = 0.5;
    double roughness = 0.5;  ///< an octave's size over that of the one before
    int size = 128;          ///< texels along a tile
    std::int64_t seed = 0;
    double threshold_low = 0.5, threshold_high = 0.7;
    double density = 1;    ///< factor on the extinction
    double coverage = -1;  ///< below 0: the thresholds as they are
    double base_m = 0, top_m = 0;
    double base_rise = 0, top_fall = 0, rounding = 0, base_density = 1;
    double planet_radius_m = 0;  ///< 0: flat
    std::array<double, 2> wind_m_per_s{0, 0};
    double time_s = 0;
    SkyEvaluation evaluate = SkyEvaluation::kAuto;

    bool has_perlin() const { return blend * perlin.gain > 0; }
    bool has_worley() const { return (1 - blend) * worley.gain > 0; }
};

/// Names of the kinds of clouds, parted by '|'; the first brings nothing of its own.
constexpr const char* kSkyTypes =
    "custom|cumulus|cumulus-maritime|stratocumulus|stratus|nimbostratus|cumulonimbus|fog";

/// A kind of cloud: its layer, shape and optics.
struct SkyType {
    const char* name;
    double base_m, top_m, coverage, perlin_m, worley_m, blend, threshold_low, threshold_high;
    double base_rise, top_fall, rounding, base_density;
    double extinction_per_m, effective_radius_um;  ///< 0: must be given
};

/// The kind of this name, which must be one of kSkyTypes.
const SkyType& sky_type(const std::string& name);

}  // namespace pileus
