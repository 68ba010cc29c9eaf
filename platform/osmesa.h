// SPDX-License-Identifier: Apache-2.0
// OpenGL by OSMesa: Mesa's renderer into memory, without display, window or graphics card.
// in: nothing -> out: an open context, or why there is none. Mesa has dropped OSMesa since 25.1;
// see egl.h for the way forward. docs/collectors.md, "Display".
#pragma once
#include "platform/gl.h"

namespace pileus {

/// Opens an OpenGL 3.3 core context. Null when it is open, else the reason in a few words. The
/// library is loaded by the first call, not when the program starts.
const char* open_osmesa(GlContext& context);

}  // namespace pileus
