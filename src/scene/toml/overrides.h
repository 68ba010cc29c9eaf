// SPDX-License-Identifier: Apache-2.0
// Applies `--set key.path=value` options to a scene's tree before it is checked.
// in: tree and untrusted option texts -> out: tree whose changed nodes know their option; faults.
// docs/scene.md, section Overrides.
#pragma once
#include <string>
#include <vector>

#include "src/scene/checks/fault_list.h"

namespace pileus {

/// Applies the options in order; a later one wins. Tables on the way are made where missing, and
/// so is the next element of `medium`; any other index must exist.
void apply_overrides(const std::vector<std::string>& overrides, Node& root, FaultList& faults);

}  // namespace pileus
