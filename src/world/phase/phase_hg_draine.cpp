// SPDX-License-Identifier: Apache-2.0
// The phase function hg-draine: water droplets of one diameter in closed form.
// in: a diameter -> out: the kernels' numbers.
// docs/phase.md, "HG and Draine"; Jendersie and d'Eon 2023, equations 4 to 7.
#include "src/base/exponential.h"
#include "src/scene/rows/phase_row.h"
#include "src/world/phase/medium_phase.h"

namespace pileus {

PhaseParams hg_draine(double d) {
    const double g_hg = exponential(-0.0990567 / (d - 1.67154));
    const double g_draine = exponential(-2.20679 / (d + 3.91029) - 0.428934);
    const double alpha = exponential(3.62489 - 8.29288 / (d + 5.52825));
    const double share = exponential(-0.599085 / (d - 0.641583) - 0.665888);
    return {kPhaseHgDraine, float(g_hg), float(g_draine), float(1 - share), float(alpha), nullptr};
}

namespace {

constexpr PhaseNumber kDiameter{"medium.N.phase.droplet_diameter_um", from_to(5, 50), "um",
                                "diameter of the droplets of hg-draine, required there"};
constexpr KeyRow kKeys[] = {phase_key<kDiameter>};

Status make(const std::string&, const PhaseSettings& settings, PhaseStore&, PhaseParams& params) {
    params = hg_draine(number_in(settings, kDiameter));
    return Status::ok();
}

}  // namespace

extern const PhaseRow hg_draine_phase{keys_of(kKeys), make};

}  // namespace pileus
