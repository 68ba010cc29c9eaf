// SPDX-License-Identifier: Apache-2.0
// The smoke cloud, read as published.
// in: PILEUS_DATA_DIR/data/smoke -> out: pass or fail, or one line why it was skipped.
// docs/testing.md, label shared
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "platform/clock.h"
#include "src/io/volumes/volume_file.h"

using namespace pileus;

TEST_CASE("smoke volume, frame 70: size, box and statistics") {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || *root == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return;
    }
    const std::string path = std::string(root) + "/data/smoke/density_render.70.pbrt";
    Volume volume;
    const double start = wall_seconds();
    const Status status = read_pbrt_volume(path, volume);
    const double seconds = wall_seconds() - start;
    INFO(status.message);
    REQUIRE(status);
    MESSAGE("read in ", seconds, " s");
    CHECK(volume.size == std::array<int, 3>{100, 100, 40});
    CHECK(volume.knows_bounds);
    CHECK(volume.bounds_m[0] == Double3{0.01, 0.01, 0.01});
    CHECK(volume.bounds_m[1] == Double3{1.99, 1.99, 0.79});

    // The published figures are rounded: half of their last digit is the tolerance.
    double sum = 0;
    int filled = 0;
    for (const float value : volume.density.span()) {
        sum += double(value);
        filled += value > 0 ? 1 : 0;
    }
    CHECK(std::fabs(sum / 400000 - 0.045590) <= 0.5e-6);
    CHECK(std::fabs(100.0 * filled / 400000 - 29.23) <= 0.005);
}
