// SPDX-License-Identifier: Apache-2.0
// Keys of procedural skies and of one procedural cloud by its type.
// in: checked values <-> out: fields of SkySettings and CloudSettings.
// docs/skies.md; docs/generators.md; Palenik 2016, section 5.1 "Shader parameters".
#include "src/scene/keys/all_keys.h"
#include "src/scene/media/cloud_types.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField sky = field<&MediumSettings::sky, Members...>;

/// Both noises have as many.
constexpr KeyField kOctaves{KeyKind::kInteger,
                            [](const KeySource& s) { return node_of(s.medium.sky.perlin.octaves); },
                            [](const KeyTarget& t, const Node& n) {
                                take(n, t.medium.sky.perlin.octaves);
                                take(n, t.medium.sky.worley.octaves);
                            }};

constexpr KeyRow kRows[] = {
    {"medium.N.sky.type", sky<&SkySettings::type>, one_of(kSkyTypes), "",
     "kind of cloud: sets what is left out of this table, and extinction and phase function where "
     "these are left out (docs/skies.md)"},
    {"medium.N.sky.perlin_m", sky<&SkySettings::perlin, &SkyNoise::tile_m>, positive(1e9), "m",
     "length after which the Perlin noise repeats", kNoNote},
    {"medium.N.sky.worley_m", sky<&SkySettings::worley, &SkyNoise::tile_m>, positive(1e9), "m",
     "length after which the Worley noise repeats", kNoNote},
    {"medium.N.sky.scale", sky<&SkySettings::scale>, positive(1e6), "", "factor on both lengths"},
    {"medium.N.sky.blend", sky<&SkySettings::blend>, from_to(0, 1), "",
     "1: Perlin noise alone, 0: Worley noise alone", kNoNote},
    {"medium.N.sky.gain_perlin", sky<&SkySettings::perlin, &SkyNoise::gain>, from_to(0, 100), "",
     "factor on the Perlin noise"},
    {"medium.N.sky.gain_worley", sky<&SkySettings::worley, &SkyNoise::gain>, from_to(0, 100), "",
     "factor on the Worley noise"},
    {"medium.N.sky.threshold_low", sky<&SkySettings::threshold_low>, from_to(-4, 5), "",
     "noise below it is no cloud (Palenik's A); the noise has mean 0.5 and deviation "
     "1/7 before blending",
     kNoNote},
    {"medium.N.sky.threshold_high", sky<&SkySettings::threshold_high>, from_to(-4, 5), "",
     "noise above it has density 1 (Palenik's B)", kNoNote},
    {"medium.N.sky.coverage", sky<&SkySettings::coverage>, from_to(0, 1), "",
     "share of the sky that clouds cover, seen straight up: moves both thresholds; 0 is no "
     "cloud at all; left out for custom, or with a threshold given: they stay",
     kNoNote},
    {"medium.N.sky.density", sky<&SkySettings::density>, from_to(0, 1e9), "",
     "factor on the extinction"},
    {"medium.N.sky.base_m", sky<&SkySettings::base_m>, from_to(-1e6, 1e9), "m",
     "altitude of the layer's base", kNoNote},
    {"medium.N.sky.top_m", sky<&SkySettings::top_m>, from_to(-1e6, 1e9), "m",
     "altitude of the layer's top", kNoNote},
    {"medium.N.sky.base_rise", sky<&SkySettings::base_rise>, from_to(0, 1), "",
     "share of the thickness over which clouds widen above the base", kNoNote},
    {"medium.N.sky.top_fall", sky<&SkySettings::top_fall>, from_to(0, 1), "",
     "share of the thickness over which clouds narrow below the top", kNoNote},
    {"medium.N.sky.rounding", sky<&SkySettings::rounding>, from_to(0, 10), "",
     "how much the noise is lowered at base and top; 0: the layer cuts clouds off", kNoNote},
    {"medium.N.sky.base_density", sky<&SkySettings::base_density>, from_to(0, 1), "",
     "density at the base over that at the top, linear between", kNoNote},
    {"medium.N.sky.planet_radius_m", sky<&SkySettings::planet_radius_m>, from_to(0, 1e12), "m",
     "bends the layer around a planet below the origin, for the Earth 6.371e6; 0: flat"},
    {"medium.N.sky.wind_m_per_s", sky<&SkySettings::wind_m_per_s>, from_to(-1000, 1000), "m/s",
     "speed of the clouds towards east and north"},
    {"medium.N.sky.time_s", sky<&SkySettings::time_s>, from_to(-1e12, 1e12), "s",
     "how long the wind has blown"},
    {"medium.N.sky.seed", sky<&SkySettings::seed>, from_to(0, 0x1p32 - 1), "",
     "another sky for each number"},
    {"medium.N.sky.size", sky<&SkySettings::size>, from_to(16, 512), "texels",
     "texels along each noise's tile: a power of two"},
    {"medium.N.sky.perlin_cells", sky<&SkySettings::perlin, &SkyNoise::cells>, from_to(1, 256), "",
     "coarsest lumps of the Perlin noise along its tile"},
    {"medium.N.sky.worley_cells", sky<&SkySettings::worley, &SkyNoise::cells>, from_to(1, 256), "",
     "coarsest lumps of the Worley noise along its tile"},
    {"medium.N.sky.octaves", kOctaves, from_to(0, 10), "",
     "octaves of both noises; 0: down to four texels per lump"},
    {"medium.N.sky.roughness", sky<&SkySettings::roughness>, from_to(0, 1), "",
     "size of an octave over that of the next coarser one"},
    {"medium.N.sky.evaluate", sky<&SkySettings::evaluate>, one_of("auto|grid|direct"), "",
     "`grid`: densities of `resolution` cells in the box; `direct`: the noise itself, by "
     "`raymarch` alone; `auto`: direct where that can be"},
};

template <auto Member>
constexpr KeyField cloud = field<&MediumSettings::cloud, Member>;

using C = CloudSettings;

constexpr KeyRow kCloudRows[] = {
    {"medium.N.cloud.type", cloud<&C::type>, one_of(kCloudTypes), "",
     "type of cloud: sets what is left out of this table, and extinction and phase function where "
     "these are left out (docs/generators.md)"},
    {"medium.N.cloud.seed", cloud<&C::seed>, from_to(0, 0x1p32 - 1), "",
     "another cloud for each number"},
    {"medium.N.cloud.height_m", cloud<&C::height_m>, from_to(1, 1e5), "m",
     "height of the tallest top over the base; left out: by the type's proportion to `radius_m`, "
     "or as large as `bounds_m` allows, or the type's",
     kNoNote},
    {"medium.N.cloud.radius_m", cloud<&C::radius_m>, from_to(1, 1e5), "m",
     "half the width of the foot; left out: by the type's proportion to `height_m`", kNoNote},
    {"medium.N.cloud.base_m", cloud<&C::base_m>, from_to(-1e6, 1e6), "m",
     "altitude of the flat base, the condensation level; left out: the type's, or just above the "
     "floor of `bounds_m`",
     kNoNote},
    {"medium.N.cloud.position_m", cloud<&C::position_m>, from_to(-1e9, 1e9), "m",
     "x and y of the middle of the foot; left out: 0, 0, or so that the cloud stands in the middle "
     "of `bounds_m`",
     kNoNote},
    {"medium.N.cloud.turrets", cloud<&C::turrets>, from_to(1, 40), "", "towers of rising air",
     kNoNote},
    {"medium.N.cloud.tall", cloud<&C::tall>, from_to(1, 40), "",
     "turrets of nearly the full height; others are lower", kNoNote},
    {"medium.N.cloud.slimness", cloud<&C::slimness>, from_to(0.08, 1), "",
     "radius of a turret over its height", kNoNote},
    {"medium.N.cloud.dilution", cloud<&C::dilution>, from_to(0, 2), "",
     "share of dry air that is mixed in at the edge, well above the base; it falls towards the "
     "core",
     kNoNote},
    {"medium.N.cloud.entrainment_per_km", cloud<&C::entrainment_per_km>, from_to(0, 20), "1/km",
     "share of outside air that a rising parcel takes in per kilometre, half of it in the core; 0: "
     "adiabatic water but for `dilution`; left out: the type's, as 1 over `height_m`, at most 3",
     kNoNote},
    {"medium.N.cloud.age", cloud<&C::age>, from_to(0, 1), "lives",
     "0: growing and crisp, 1: soft, thin and falling apart", kNoNote},
    {"medium.N.cloud.age_s", cloud<&C::age_s>, from_to(-1e9, 1e9), "s",
     "seconds since the cloud's first turret rose: it grows, ages and is gone after `lifetime_s`; "
     "clouds of a field live one after the other; films add `wind_s`; left out: full-grown",
     kNoNote},
    {"medium.N.cloud.lifetime_s", cloud<&C::lifetime_s>, from_to(1, 1e7), "s",
     "life of a cloud with an `age_s`, in a field that of the largest", kNoNote},
    {"medium.N.cloud.outline", cloud<&C::outline>, from_to(0, 2), "",
     "bends of the outline seen from above, over `radius_m`", kNoNote},
    {"medium.N.cloud.shear", cloud<&C::shear>, from_to(0, 10), "",
     "drift of the tallest top with the wind over its height", kNoNote},
    {"medium.N.cloud.wind_deg", cloud<&C::wind_deg>, from_to(-360, 360), "deg",
     "direction of that drift, from east towards north"},
    {"medium.N.cloud.turn_deg", cloud<&C::turn_deg>, from_to(-360, 360), "deg",
     "that the wind veers (turns clockwise seen from above) from the base to the top, which drifts "
     "along `wind_deg`; of cirrus from the foot of a streak to its head"},
    {"medium.N.cloud.anvil", cloud<&C::anvil>, from_to(0, 3), "",
     "radius of an anvil of ice over `height_m`; 0: none", kNoNote},
    {"medium.N.cloud.plates", cloud<&C::plates>, from_to(1, 12), "",
     "lenses upon one another, of lenticularis", kNoNote},
    {"medium.N.cloud.cell_m", cloud<&C::cell_m>, from_to(1, 1e6), "m",
     "width of a layer's cells, or of a streak's head; the box holds a whole number", kNoNote},
    {"medium.N.cloud.cover", cloud<&C::cover>, from_to(0, 1), "",
     "share of the ground under cloud, of fields and layers", kNoNote},
    {"medium.N.cloud.erosion", cloud<&C::erosion>, from_to(0, 0.5), "",
     "share of its size that each octave of lumps takes off the surface: 0.2 is crisp, 0.13 keeps "
     "the mean"},
    {"medium.N.cloud.mamma", cloud<&C::mamma>, from_to(0, 1), "",
     "pouches that hang under an anvil; 1: as deep as half their width"},
    {"medium.N.cloud.shelf", cloud<&C::shelf>, from_to(0, 1), "",
     "a lip under the base at the side that the wind blows to, and shreds: share of the height's "
     "4 % by which it hangs down; 0: a flat base"},
    {"medium.N.cloud.rain", cloud<&C::rain>, from_to(0, 1), "",
     "rain under congestus, cumulonimbus and nimbostratus as a share of 50 mm/h; little ends in "
     "the air. The box left out reaches down to the ground, or to z = 0"},
};

}  // namespace

Span<const KeyRow> sky_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }
Span<const KeyRow> cloud_keys() { return {kCloudRows, sizeof kCloudRows / sizeof kCloudRows[0]}; }

}  // namespace pileus
