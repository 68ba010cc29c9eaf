// SPDX-License-Identifier: Apache-2.0
// The phase functions isotropic and henyey-greenstein.
// in: g -> out: the kernels' numbers.
// docs/phase.md; Henyey and Greenstein 1941.
#include "kernels_cpu/media/phase.h"
#include "src/scene/rows/phase_row.h"

namespace pileus {
namespace {

constexpr PhaseNumber kG{"medium.N.phase.g", from_to(-1, 1), "",
                         "mean cosine of henyey-greenstein, required there; 1 is straight on"};
constexpr KeyRow kKeys[] = {phase_key<kG>};

/// The same in all directions is what the numbers say that are left alone.
Status make_isotropic(const std::string&, const PhaseSettings&, PhaseStore&, PhaseParams& params) {
    params = {};
    return Status::ok();
}

Status make(const std::string&, const PhaseSettings& settings, PhaseStore&, PhaseParams& params) {
    params = {kPhaseHg, float(number_in(settings, kG)), 0, 1};
    return Status::ok();
}

}  // namespace

extern const PhaseRow isotropic_phase{{}, make_isotropic};
extern const PhaseRow henyey_greenstein_phase{keys_of(kKeys), make};

}  // namespace pileus
