// SPDX-License-Identifier: Apache-2.0
// Types of procedural clouds, and what each is where the scene does not say otherwise.
// in: a name, settings -> out: a row; settings with nothing left out. docs/generators.md
#pragma once
#include "src/scene/media/cloud_settings.h"

namespace pileus {

/// Names of the types, parted by '|'.
constexpr const char* kCloudTypes =
    "cumulus-humilis|cumulus-mediocris|cumulus-congestus|cumulonimbus|cumulus-field|stratocumulus|"
    "stratocumulus-open|altocumulus|stratus|fog|cirrus";

/// What makes a type.
enum class CloudForm {
    kHeap,    ///< one heap of rising air
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
    int turrets, tall;
    double slimness, dilution, age, outline, shear;
    double anvil, cell_m, cover;
    double extinction_per_m;     ///< 0: that of adiabatic water
    double effective_radius_um;  ///< 0: that of adiabatic water; below: ice
};

/// The type of this name, which must be one of kCloudTypes.
const CloudType& cloud_type(const std::string& name);

/// The settings with nothing left out but the place; sizes keep the type's proportions where one
/// of them is given.
CloudSettings resolved_cloud(const CloudSettings& settings);

/// Height over the condensation level at which the density is 1, m.
double full_height_m(double height_m);
/// Extinction of adiabatic water at that height in 1/m: 0.18 at 1 km, by height^(2/3).
double cloud_extinction_per_m(double height_m);
/// Effective radius of the droplets in the middle of the cloud, um, within 4..20.
double cloud_radius_um(double height_m);

}  // namespace pileus
