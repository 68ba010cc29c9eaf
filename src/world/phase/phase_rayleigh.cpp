// SPDX-License-Identifier: Apache-2.0
// The phase function rayleigh: molecules.
// in: nothing -> out: the kernels' numbers.
// docs/phase.md; Rayleigh 1871.
#include "kernels_cpu/media/phase.h"
#include "src/scene/rows/phase_row.h"

namespace pileus {
namespace {

Status make(const std::string&, const PhaseSettings&, PhaseStore&, PhaseParams& params) {
    params = {kPhaseRayleigh, 0, 0, 1};
    return Status::ok();
}

}  // namespace

extern const PhaseRow rayleigh_phase{{}, make};

}  // namespace pileus
