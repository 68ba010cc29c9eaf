// SPDX-License-Identifier: Apache-2.0
// The scenes of real clouds render as they are.
// in: assets/scenes, PILEUS_DATA_DIR -> out: pass or fail, or one line why it was skipped.
// docs/testing.md, label shared
#include "tests/support/asset_scenes.h"

#include <cstdlib>

TEST_CASE("asset scenes: those of real clouds render") {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || *root == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return;
    }
    const std::vector<std::string> scenes = asset_scenes::find(true);
    CHECK(scenes.size() >= 5);
    for (const std::string& file : scenes) asset_scenes::check_renders(file);
}
