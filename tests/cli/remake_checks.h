// SPDX-License-Identifier: Apache-2.0
// What tests of pictures in place of scenes share.
// in: nothing -> out: whether this build has such pictures.
// docs/program.md, "A picture made again"
#pragma once
#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"

namespace pileus {
namespace test {

/// Pictures hold scenes in EXR files alone.
inline bool skips_pictures() {
    const bool none = !can_write_image("a.exr");
    if (none) MESSAGE("skipped: no OpenEXR in this build");
    return none;
}

}  // namespace test
}  // namespace pileus
