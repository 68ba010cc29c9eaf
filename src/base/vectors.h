// SPDX-License-Identifier: Apache-2.0
// Vectors of the host side: places, directions, colours, by GLM. Kernels have lanes of their own.
// docs/determinism.md, "How": of GLM only what adds, multiplies, divides and takes
// roots may reach a pixel; nothing of it that calls libm.
#pragma once
#include <glm/vec3.hpp>

namespace pileus {

using Double3 = glm::dvec3;

}  // namespace pileus
