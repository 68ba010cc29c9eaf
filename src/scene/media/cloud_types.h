// SPDX-License-Identifier: Apache-2.0
// Types of procedural clouds, and what each is where the scene does not say otherwise.
// in: a name, settings -> out: a row; settings with nothing left out. docs/generators.md
#pragma once
#include "src/scene/media/cloud_settings.h"

namespace pileus {

/// Names of the types, parted by '|'.
constexpr const char* kCloudTypes =
    "cumulus-humilis|cumulus-mediocris|cumulus-congestus|cumulonimbus|cumulus-field|stratocumulus|"
    "stratocumulus-open|altocumulus|altocumulus-lenticularis|stratus|nimbostratus|fog|cirrus|"
    "cirrus-uncinus|cirrostratus";

/// What makes a type.
enum class CloudForm {
    kHeap,    ///< one heap of rising air
    kLens,    ///< smooth lenses upon one another
    kField,   ///< many of them
    kClosed,  ///< layers: CloudLayerForm
    kOpen,
    kSheet,
    kGround,  ///< a sheet that lies on the ground
    kStreaks,
};

/// What a type of cloud is where the scene does not say otherwise; units as above.
struct CloudType {
    const char* name;
    CloudForm form;
    double height_m, radius_m, base_m;
    int turrets, tall;  ///< of lenses: plates
    double slimness, dilution, entrainment_per_km, age, outline, shear;
    double anvil, cell_m, cover;
    double extinction_per_m;     ///< 0: that of adiabatic water
    double effective_radius_um;  ///< 0: that of adiabatic water; below: ice
    double lifetime_s = 0;       ///< of heaps, and of a field's largest
    bool rains = false;          ///< may have rain below
    double lump = 0.16;          ///< largest lumps' width over the height, without an anvil
};

/// The type of this name, which must be one of kCloudTypes.
const CloudType& cloud_type(const std::string& name);

/// The settings with nothing left out but the place; sizes keep the type's proportions where one
/// of them is given.
CloudSettings resolved_cloud(const CloudSettings& settings);

/// Air that a cloud of this height takes in, 1/km: what is asked, or the type's, falling with size.
double cloud_entrainment_per_km(const CloudSettings& settings, double height_m);

/// Height over the condensation level at which the density is 1, m.
double full_height_m(double height_m);
/// Extinction of adiabatic water at that height in 1/m: 0.18 at 1 km, by height^(2/3).
double cloud_extinction_per_m(double height_m);
/// Effective radius of the droplets in the middle of the cloud, um, within 4..20.
double cloud_radius_um(double height_m);

}  // namespace pileus
