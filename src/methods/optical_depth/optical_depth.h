// SPDX-License-Identifier: Apache-2.0
// Method `optical-depth`: the look of clouds from one buffer of optical depths towards the sun.
// in: a scene -> out: an image without noise; appearance, not physics.
// Maerkl 2018, 3.1 and 4.4; docs/optical-depth.md
#pragma once
#include "src/methods/methods.h"

namespace pileus {

/// The recipe.
const Recipe& optical_depth_method();
extern const MethodTools optical_depth_tools;

}  // namespace pileus
