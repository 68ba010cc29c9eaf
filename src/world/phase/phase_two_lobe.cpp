// SPDX-License-Identifier: Apache-2.0
// The phase function two-lobe: weight*HG(g1) + (1-weight)*HG(g2).
// in: both mean cosines, a share -> out: the kernels' numbers.
// docs/phase.md.
#include "kernels_cpu/media/phase.h"
#include "src/scene/rows/phase_row.h"

namespace pileus {
namespace {

constexpr PhaseNumber kG1{"medium.N.phase.g1", from_to(-1, 1), "",
                          "mean cosine of the first of two lobes, required there"};
constexpr PhaseNumber kG2{"medium.N.phase.g2", from_to(-1, 1), "",
                          "mean cosine of the second of two lobes, required there"};
constexpr PhaseNumber kWeight{"medium.N.phase.weight", from_to(0, 1), "",
                              "share of the first of two lobes, required there", 1};
constexpr KeyRow kKeys[] = {phase_key<kG1>, phase_key<kG2>, phase_key<kWeight>};

Status make(const std::string&, const PhaseSettings& settings, PhaseStore&, PhaseParams& params) {
    params = {kPhaseTwoLobe, float(number_in(settings, kG1)), float(number_in(settings, kG2)),
              float(number_in(settings, kWeight))};
    return Status::ok();
}

}  // namespace

extern const PhaseRow two_lobe_phase{keys_of(kKeys), make};

}  // namespace pileus
