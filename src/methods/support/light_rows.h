// SPDX-License-Identifier: Apache-2.0
// Sun, sky, air, lamps and light of the media.
// in: nothing -> out: rows of the support table, entries in the order of MethodColumn.
// docs/support.md
#pragma once
#include "src/methods/support/make_rows.h"

namespace pileus {
namespace support_rows {

constexpr Support kNoLamps =
    refused("not for collectors as billboards in this version",
            "collectors.display = \"march\", another method, or a scene without [[light]]");
constexpr Support kNoLampsInClouds = refused("conflicts with [clouds]", "left out");

constexpr const char* kSharp = "a point, as the plan says: sharp shadows; 2 % of the mean";
constexpr const char* kAppearance = "as the sun: an appearance without it, docs/optical-depth.md";

constexpr Support kNotInAir = refused(kSkyInAir, kSkyInAirAllowed);

constexpr FeatureRow kLightRows[] = {
    row(Feature::kSun, FeatureGroup::kOfLight, "sun, a point", "sun",
        "cumulus, cirrus and stratocumulus against paths and independent codes",
        bounded("-2.5 to +1.5 % of the picture's mean; -9 to +5 % of media on cells above one "
                "optical depth; boxes whose faces a sun grazes are half as bright there"),
        bounded("-0.4 to +1.2 % of the picture's mean, -7 to +5 % of the medium's; boxes -18 %"),
        bounded("-2.9 to +0.7 % of the picture's mean; of media as collectors"), exact("0.2 %"),
        bounded("-5 to +5 % of the mean; grazing light or views of thick decks -12 to +9 %"),
        bounded("by design: -15 to -95 % of the mean; what is below to +15 %"),
        bounded(
            "-4 to +4 % of the mean where particles are thin; thick ones -24 %, with a warning"),
        bounded("-4 to +4 % of the mean where particles are thin; thick ones -26 %"),
        bounded("as its kinds; late by up to sun_deg")),
    row(Feature::kSunDisc, FeatureGroup::kOfLight, "sun.angular_radius_deg",
        "sun.angular_radius_deg", "a host's sun has none", bounded(kSharp), bounded(kSharp),
        bounded(kSharp), exact(), bounded(kSharp), bounded(kSharp), bounded(kSharp),
        bounded(kSharp), bounded(kSharp)),
    row(Feature::kSetInAir, FeatureGroup::kOfLight,
        "set_sky, or set_sun without one, under [atmosphere]", "", "of a session", kNotInAir,
        kNotInAir, kNotInAir, kNotInAir, kNotInAir, kNotInAir, kNotInAir, kNotInAir, kNotInAir),
    row(Feature::kSkyConstant, FeatureGroup::kOfLight, "constant sky on media", "sky.radiance", "",
        exact(), exact(), exact(), exact(), bounded("-4 to +4 %"), bounded(kAppearance),
        bounded("as the sun"), bounded("as the sun"), bounded("as its kinds")),
    row(Feature::kSkyMap, FeatureGroup::kOfLight, "sky.map on media", "sky.map", "",
        bounded("-22 to +23 % under one bright patch"),
        bounded("of a board's middle: -22 to +23 % under one bright patch"),
        bounded("as collectors"), exact(), bounded("-5 to +5 %"), bounded(kAppearance),
        bounded("as the sun"), bounded("as the sun"),
        refused("conflicts with [clouds]", "left out")),
    row(Feature::kGroundUnderMap, FeatureGroup::kOfLight, "the ground under sky.map", "", "",
        exact(), exact(), exact(), exact(), exact(), exact(), exact(), exact(),
        refused("conflicts with [clouds]", "left out")),
    row(Feature::kAir, FeatureGroup::kOfLight, "[atmosphere]: sky, sunlight, haze before things",
        "atmosphere", "", bounded("sky -1 to -3 %; haze -8 to +4 %"), bounded("as collectors"),
        bounded("as collectors"), bounded("as collectors"), bounded("as collectors"),
        bounded("as collectors"), bounded("as collectors"), bounded("as collectors"),
        bounded("as collectors")),
    row(Feature::kAirOnMedia, FeatureGroup::kOfLight, "the air's sky on media", "", "",
        bounded("-2.8 to +2.8 %"), bounded("-2.8 to +3 %"), bounded("-1.0 to +1.0 %"),
        exact("-1.4 to +0.3 %"), bounded("-3 to +3 %"), bounded(kAppearance), bounded("as the sun"),
        bounded("as the sun"), bounded("as its kinds")),
    row(Feature::kGroundUnderAir, FeatureGroup::kOfLight, "the ground under [atmosphere]", "", "",
        exact("0.8 %"), exact(), exact(), exact("0.8 %"), exact("0.8 %"), exact("0.8 %"),
        exact("0.8 %"), exact("0.8 %"), exact("0.8 %, beside clouds' own light on it")),
    row(Feature::kLampParallel, FeatureGroup::kOfLight, "[[light]] directional", "light.N.type", "",
        bounded("0 to +2 %; grazing at g 0.85 -8 %"), kNoLamps,
        bounded("-2 to -1 %; grazing at g 0.85 -6 %"), exact("3 %"), bounded("-3 to +2 %"),
        bounded("as the sun: by design"), bounded("one value a ball: -15 %"),
        bounded("one value a ball: -15 %"), kNoLampsInClouds),
    row(Feature::kLampPoint, FeatureGroup::kOfLight, "[[light]] point", "light.N.type", "",
        bounded("-6 to +10 %; close before a cloud +16 %, grazing at g 0.85 -21 %"), kNoLamps,
        bounded("-5 to +7 %; grazing at g 0.85 -23 %"), exact("0.2 %"),
        bounded("-2 to +6 %; in boxes much wider than they are high -17 %"), bounded("fog -70 %"),
        bounded("-16 %"), bounded("-16 %"), kNoLampsInClouds),
    row(Feature::kLampSpot, FeatureGroup::kOfLight, "[[light]] spot", "light.N.type", "",
        bounded("-1 to 0 % beside the camera"), kNoLamps, bounded("-2 % beside the camera"),
        exact("of photon methods, 2 %"), bounded("-5 to +2 %, beside the camera, too"),
        bounded("as the sun: by design"), bounded("one value a ball: -15 %"),
        bounded("one value a ball: -15 %"), kNoLampsInClouds),
    row(Feature::kLampSphere, FeatureGroup::kOfLight, "[[light]] with radius_m, shadow_samples",
        "light.N.radius_m", "", bounded("-3.7 to +2.5 % at g <= 0.6"), kNoLamps,
        bounded("-3.6 to +0.6 % at g <= 0.6"), exact("0.2 %"), bounded("-5.1 to 0 %"),
        bounded("as the sun: by design"), bounded("-15 %"), bounded("-15 %"), kNoLampsInClouds),
    row(Feature::kEmission, FeatureGroup::kOfLight, "medium.emission", "medium.N.emission", "",
        bounded("-3 to +3 % of the mean, on deep cells too"),
        refused("not by collectors as billboards in this version",
                "collectors.display = \"march\", or another method"),
        bounded("as collectors"), exact("0.03 %"),
        bounded("-5 to +1 %; thick media that absorb next to nothing lose a half and more, with a "
                "warning; octaves: unscattered, -30 to -67 % at albedo 0.6 to 0.9"),
        bounded("unscattered: -30 to -67 % at albedo 0.6 to 0.9"), bounded("as the sun"),
        bounded("as the sun"), bounded("as its kinds")),
};

}  // namespace support_rows
}  // namespace pileus
