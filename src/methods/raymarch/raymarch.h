// SPDX-License-Identifier: Apache-2.0
// Method `raymarch`: sunlight scattered once, or forward many times, added up along each ray.
// in: a scene -> out: an image without noise, as fine as its steps.
// Palenik 2016; docs/raymarch.md
#pragma once
#include "src/methods/methods.h"

namespace pileus {

/// The recipe.
const Recipe& raymarch_method();
extern const MethodTools raymarch_tools;

}  // namespace pileus
