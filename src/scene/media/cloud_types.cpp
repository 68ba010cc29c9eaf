// SPDX-License-Identifier: Apache-2.0
// Types of procedural clouds: sizes, shapes, water.
// in: a name -> out: a row. Sizes after the WMO's International Cloud Atlas (2017); shapes by eye
// and by the measures of docs/generators.md, "Measured". Water: 2.2 g/m^3 per km of adiabatic rise.
#include "src/scene/media/cloud_types.h"

#include <algorithm>

#include "src/base/powers.h"

namespace pileus {
namespace {

using F = CloudForm;

constexpr CloudType lumpy(double lump, CloudType type) {
    type.lump = lump;
    return type;
}

constexpr CloudType raining(CloudType type) {
    type.rains = true;
    return type;
}

// name, form, height, radius, base, turrets, tall, slimness, dilution, entrainment, age, outline,
// shear, anvil, cell, cover, extinction, effective radius, lifetime (Cotton, Bryan, van den Heever
// 2011, ch. 7, 8)
constexpr CloudType kTypes[] = {
    {"cumulus-humilis", F::kHeap, 280, 330, 900, 12, 3, 0.26, 0.25, 1.2, 0.1, 0.5, 0.15, 0, 0, 0, 0,
     0, 900},
    {"cumulus-mediocris", F::kHeap, 650, 600, 900, 16, 5, 0.26, 0.25, 1.5, 0.1, 0.45, 0.18, 0, 0, 0,
     0, 0, 1500},
    raining({"cumulus-congestus", F::kHeap, 1300, 700, 900, 12, 4, 0.24, 0.25, 1.2, 0, 0.35, 0.12,
             0, 0, 0, 0, 0, 2700}),
    raining({"cumulonimbus", F::kHeap, 10200, 5200, 900, 22, 3, 0.19, 0.3, 0.15, 0, 0.4, 0.3, 0.9,
             0, 0, 0.1, 12, 5400}),
    lumpy(0.24, {"cumulus-field", F::kField, 950, 600, 900, 9, 2, 0.3, 0.25, 1.5, 0.15, 1.2, 0.15,
                 0, 0, 0.25, 0, 0, 1500}),
    {"stratocumulus", F::kClosed, 330, 0, 700, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1100, 0.85, 0, 0},
    {"stratocumulus-open", F::kOpen, 450, 0, 700, 1, 1, 1, 0, 0, 0, 0, 0, 0, 4500, 0.45, 0, 0},
    {"altocumulus", F::kClosed, 170, 0, 3500, 1, 1, 1, 0, 0, 0, 0, 0, 0, 420, 0.6, 0.03, 8},
    {"altocumulus-lenticularis", F::kLens, 1100, 3500, 4200, 5, 1, 1, 0, 0, 0, 0.15, 0.4, 0, 0, 0,
     0.03, 6},
    {"stratus", F::kSheet, 300, 0, 300, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1600, 0.97, 0.05, 7.33},
    raining(
        {"nimbostratus", F::kSheet, 2800, 0, 500, 1, 1, 1, 0, 0, 0, 0, 0, 0, 6000, 1, 0.04, 10}),
    {"fog", F::kGround, 90, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 700, 0.95, 0.02, 10.7},
    {"cirrus", F::kStreaks, 1500, 0, 8000, 1, 1, 1, 0, 0, 0, 0, 2.8, 0, 900, 0.4, 0.004, -1},
    {"cirrus-uncinus", F::kStreaks, 1800, 0, 8000, 1, 1, 1, 0, 0, 0, 0, 4, 0, 500, 0.15, 0.006, -1},
    {"cirrostratus", F::kSheet, 900, 0, 7500, 1, 1, 1, 0, 0, 0, 0, 0, 0, 4000, 1, 0.0015, -1},
};

double or_else(double value, double of_type) { return value == kOfType ? of_type : value; }

}  // namespace

const CloudType& cloud_type(const std::string& name) {
    for (const CloudType& type : kTypes)
        if (name == type.name) return type;
    return kTypes[1];
}

CloudSettings resolved_cloud(const CloudSettings& settings) {
    const CloudType& type = cloud_type(settings.type);
    CloudSettings out = settings;
    const bool tall = settings.height_m != kOfType, wide = settings.radius_m != kOfType;
    const bool in_proportion = wide && type.radius_m > 0;
    if (!tall)
        out.height_m =
            in_proportion ? settings.radius_m * (type.height_m / type.radius_m) : type.height_m;
    if (!wide) out.radius_m = out.height_m * (type.radius_m / type.height_m);
    out.base_m = or_else(settings.base_m, type.base_m);
    if (settings.turrets == kCountOfType) out.turrets = type.turrets;
    if (settings.plates == kCountOfType) out.plates = type.turrets;
    if (settings.tall == kCountOfType) out.tall = type.tall;
    out.slimness = or_else(settings.slimness, type.slimness);
    out.dilution = or_else(settings.dilution, type.dilution);
    out.entrainment_per_km = cloud_entrainment_per_km(settings, out.height_m);
    out.age = or_else(settings.age, type.age);
    out.lifetime_s = or_else(settings.lifetime_s, type.lifetime_s);
    out.outline = or_else(settings.outline, type.outline);
    out.shear = or_else(settings.shear, type.shear);
    out.anvil = or_else(settings.anvil, type.anvil);
    out.cell_m = or_else(settings.cell_m, type.cell_m);
    out.cover = or_else(settings.cover, type.cover);
    return out;
}

double cloud_entrainment_per_km(const CloudSettings& settings, double height_m) {
    const CloudType& type = cloud_type(settings.type);
    return or_else(settings.entrainment_per_km,
                   std::min(3.0, type.entrainment_per_km * (type.height_m / height_m)));
}

double full_height_m(double height_m) { return 1.15 * height_m; }

double cloud_extinction_per_m(double height_m) {
    const double root = cube_root(full_height_m(height_m) / 1000);
    return 0.18 * root * root;
}

double cloud_radius_um(double height_m) {
    // 1.5 q / (rho beta), of 2.2 g/m^3 and 0.18 /m: 18 um at 1 km.
    return std::min(20.0, std::max(4.0, 18.3 * cube_root(0.6 * height_m / 1000)));
}

}  // namespace pileus
