// SPDX-License-Identifier: Apache-2.0
// See check_support.h.
#include "src/methods/check_support.h"

#include "src/scene/method_column.h"
#include "src/scene/rows/layer_flags.h"

namespace pileus {

Status check_budget_kinds(const Scene& scene, const Budget& budget) {
    const struct {
        bool given;
        const char* option;
        Feature feature;
    } kinds[] = {{budget.photons >= 0, "--budget photons", Feature::kBudgetPhotons},
                 {budget.generations > 0, "--budget generations", Feature::kBudgetPhotons},
                 {budget.samples >= 0, "--budget samples", Feature::kBudgetSamples},
                 {budget.steps >= 0, "--budget steps", Feature::kBudgetSteps},
                 {budget.error > 0, "--budget error", Feature::kBudgetError},
                 {budget.seconds > 0, "--budget seconds", Feature::kBudgetSeconds},
                 {!budget.state.empty(), "--state", Feature::kState}};
    for (const auto& kind : kinds) {
        const Support* no = refused(scene, kind.feature);
        if (!kind.given || no == nullptr) continue;
        if (*no->text == 0) return unknown_budget(kind.option, scene.method, no->allowed);
        return Status::bad_input(std::string(kind.option) + ": " + no->text +
                                 ", allowed: " + no->allowed);
    }
    return Status::ok();
}

Status check_layer_kinds(const Scene& scene) {
    for (const LayerFlag& layer : kLayerFlags) {
        const Support* no = refused(scene, layer.feature);
        if (scene.output.*layer.wanted && no != nullptr)
            return Status::bad_input(scene.file + ": output.layers: " + no->text +
                                     ", allowed: " + no->allowed);
    }
    return Status::ok();
}

}  // namespace pileus
