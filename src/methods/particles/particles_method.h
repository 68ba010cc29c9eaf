// SPDX-License-Identifier: Apache-2.0
// Method `particles`: a medium of particles, lit and shown by themselves and not on a grid.
// in: a scene with a file of particles -> out: an image without noise.
// Monette and Whitehead 2014; docs/particles.md, "The method".
#pragma once
#include "src/methods/methods.h"

namespace pileus {

/// The recipe.
const Recipe& particles_method();

}  // namespace pileus
