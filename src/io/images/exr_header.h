// SPDX-License-Identifier: Apache-2.0
// What the two files that touch OpenEXR share. Nothing else includes it.
// in: an Image -> out: its header. docs/formats.md
#pragma once
#ifdef PILEUS_WITH_OPENEXR
#include <ImfHeader.h>

#include "src/io/images/image.h"

namespace pileus {

/// Windows, camera, texts and channels; 32-bit floats, ZIP. Throws as OpenEXR does.
Imf::Header make_header(const Image& image);

}  // namespace pileus
#endif
