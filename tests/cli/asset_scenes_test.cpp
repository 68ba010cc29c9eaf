// SPDX-License-Identifier: Apache-2.0
// The scenes that come with the program render as they are, within the limits of every run.
// in: assets/scenes -> out: pass or fail.
// docs/testing.md, label cli
#include "tests/support/asset_scenes.h"

#include "tests/support/long_tests.h"

TEST_CASE("asset scenes: those that need no other data render") {
    const std::vector<std::string> scenes = asset_scenes::find(false);
    CHECK(scenes.size() >= 3);
    // All are read; in the short form every other one is rendered, which takes most of the time.
    const std::size_t stride = pileus::row_stride(2);
    for (std::size_t number = 0; number < scenes.size(); ++number) {
        CAPTURE(scenes[number]);
        pileus::Scene scene;
        const pileus::Status read = pileus::read_scene_file(scenes[number], {}, scene);
        CHECK_MESSAGE(bool(read), read.message);
        if (number % stride == 0) asset_scenes::check_renders(scenes[number]);
    }
}
