// SPDX-License-Identifier: Apache-2.0
// The version, from the build's one place.
// in: PILEUS_VERSION_TEXT -> out: kVersion.
// docs/program.md
#include "src/session/render.h"

namespace pileus {

const char* const kVersion = PILEUS_VERSION_TEXT;

}  // namespace pileus
