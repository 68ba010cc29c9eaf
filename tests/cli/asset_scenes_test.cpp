// SPDX-License-Identifier: Apache-2.0
// The scenes that come with the program render as they are, within the limits of every run.
// in: assets/scenes -> out: pass or fail.
// docs/testing.md, label cli
#include "tests/support/asset_scenes.h"

TEST_CASE("asset scenes: those that need no other data render") {
    const std::vector<std::string> scenes = asset_scenes::find(false);
    CHECK(scenes.size() >= 3);
    for (const std::string& file : scenes) asset_scenes::check_renders(file);
}
