// SPDX-License-Identifier: Apache-2.0
// The lights of a scene besides sun and sky, as kernels take them.
// in: [[light]] of a scene, the medium's box -> out: lamps; those that bring nothing left out.
// docs/lights.md.
#pragma once
#include <vector>

#include "kernels_cpu/light/lamp_params.h"
#include "src/plan/plan.h"
#include "src/scene/scene.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// Lights in box-local metres. Dark ones and those below a ground's altitude are left out: the
/// ground hides them from all that is above.
std::vector<LampParams> make_lamps(const std::vector<LightSettings>& lights, const Ground& ground,
                                   const Medium& medium);
/// Which were left out, and why.
void explain_lamps(const std::vector<LightSettings>& lights, const Ground& ground,
                   const Medium& medium, Plan& plan);

bool same_lamps(const std::vector<LampParams>& a, const std::vector<LampParams>& b);

}  // namespace pileus
