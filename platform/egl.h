// SPDX-License-Identifier: Apache-2.0
// OpenGL by EGL without a surface: Mesa's software renderer or a graphics card, no display needed.
// in: nothing -> out: an open context, or why there is none. What follows OSMesa, which Mesa has
// dropped. docs/collectors.md, "Display".
#pragma once
#include "platform/gl.h"

namespace pileus {

/// Opens an OpenGL 3.3 core context. Null when it is open, else the reason in a few words. The
/// library is loaded by the first call, not when the program starts.
const char* open_egl(GlContext& context);

}  // namespace pileus
