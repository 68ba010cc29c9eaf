// SPDX-License-Identifier: Apache-2.0
// A recipe as a method: its live functions over a run.
// in: a recipe, a run that it made -> out: a Method, a MethodReport.
// docs/architecture.md, "Methods"
#pragma once
#include "src/methods/methods.h"

namespace pileus {

/// The recipe's row, by which it is found.
MethodRow row_of(const Recipe& recipe);

/// `recipe` and `run`, which it made, outlive what is returned.
MadeMethod method_of(const Recipe& recipe, MethodRun& run);

/// Whether hosts have sessions of it, as of all that are classes.
bool is_live(const MethodRow& row);

}  // namespace pileus
