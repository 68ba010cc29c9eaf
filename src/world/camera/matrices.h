// SPDX-License-Identifier: Apache-2.0
// A host's view and projection matrices as our camera, and what its depth buffer counts.
// in: column-major matrices as of OpenGL, Vulkan or Direct3D -> out: Camera, DepthScale.
// docs/embedding.md, "Cameras"; OpenGL 4.6 specification, section 13.8.
#pragma once
#include <glm/mat4x4.hpp>

#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

/// How a depth buffer counts: the value of a point z metres in front of the camera is
/// (a z + b) / (c z + d) in clip space, where it goes from `lowest` to 1, and in the buffer from 0.
struct DepthScale {
    bool known = false;  ///< a camera without near and far has none
    double a = 0, b = 0, c = 1, d = 0;
    double lowest = 0;
    double far_value = 1;  ///< of the buffer where nothing is

    /// Metres in front of the camera; infinity at the far end, 0 for what is no such number.
    double metres(double value) const;
    double value(double metres) const;
};

/// Of a perspective or orthographic camera from `near_m` on; `far_m` 0: without end.
DepthScale depth_scale(bool orthographic, double near_m, double far_m);

/// Fills position, target, up and frustum of `camera` and `scale`. `zero_to_one`: of clip space's
/// depth. kBadInput: a view that is no rigid motion, a projection of another kind.
Status camera_from_matrices(const glm::dmat4& view, const glm::dmat4& projection, bool zero_to_one,
                            Camera& camera, DepthScale& scale);

}  // namespace pileus
