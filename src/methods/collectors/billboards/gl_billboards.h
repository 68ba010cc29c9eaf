// SPDX-License-Identifier: Apache-2.0
// Billboards blended by OpenGL, to compare the built-in blender with a foreign one.
// in: the same spheres, camera and depths of solids -> out: transmittance and colour, no half
// depth. docs/collectors.md, "Display". Its bits are the driver's: never golden, never the default.
#pragma once
#include "platform/gl.h"
#include "src/methods/collectors/billboards/composite_billboards.h"
#include "src/scene/scene.h"

namespace pileus {

/// An open context with the program that draws spheres; usable in the thread that opened it.
struct GlBlender {
    GlContext context;
    unsigned program = 0, vertices = 0, picture = 0, solid = 0;
};

/// Opens the library that `compositor` names. kBadInput: this build or this machine has none, or it
/// lacks OpenGL 3.3 with pictures of floats.
Status open_gl_blender(Compositor compositor, GlBlender& blender);

/// Blends as composite_billboards does, with the same profile and order, into pictures of 32-bit
/// floats; what lies behind a transmittance of 10^-4 still counts. kBadInput: a sphere or camera
/// out of range, or a half depth wanted; kLimit: more than 16384 pixels a side, or no memory.
Status blend_by_gl(GlBlender& blender, const BillboardScene& scene, const CameraParams& camera,
                   int threads, BillboardImage& out);

}  // namespace pileus
