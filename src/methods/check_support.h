// SPDX-License-Identifier: Apache-2.0
// What a method refuses of budgets and layers, by the support table.
// in: scene, budget -> out: the first fault.
// docs/support.md
#pragma once
#include "src/methods/scenery.h"

namespace pileus {

/// kBadInput: a kind of budget that the scene's method does not know.
Status check_budget_kinds(const Scene& scene, const Budget& budget);

/// kBadInput: a layer that the scene's method does not make.
Status check_layer_kinds(const Scene& scene);

}  // namespace pileus
