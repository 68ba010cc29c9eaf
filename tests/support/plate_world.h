// SPDX-License-Identifier: Apache-2.0
// A plate of two metres in a file, and a box of 8 m seen from above, for tests of solids in media.
// in: what stands in the box and lights it -> out: text of a scene.
// docs/solids.md
#pragma once
#include <string>

#include "src/base/file.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

namespace plate_test {

struct Files {
    pileus::test::TempFolder folder;
    std::string square = folder.path("square.obj");

    Files() {
        const std::string text = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
        REQUIRE(pileus::write_file(square, {text.data(), text.size()}));
    }
    std::string plate(const char* more) const {
        return "[[solid]]\nfile = \"" + square + "\"\n" + more + "\n";
    }
};

/// A box of 8 m seen from above; the sun stands in the north, half way up. `medium` goes on with
/// the box's own keys.
inline std::string world(const char* medium, const char* light) {
    return std::string(R"(
seed = 5
[camera]
position_m = [0, 0, 50]
target_m = [0, 0, 0]
up = [0, 1, 0]
projection = "orthographic"
height_m = 8
resolution = [16, 16]
[collectors]
photons = 200_000
generations = 8
[path]
samples_per_pixel = 256
[[medium]]
density = "uniform:box"
bounds_m = [[-4, -4, -4], [4, 4, 4]]
resolution = [32, 32, 32]
)") + medium +
           light;
}
constexpr const char* kSun = "[sun]\nazimuth_deg = 0\nelevation_deg = 45\n";

/// Mean of a colour channel over rows of a picture.
inline double mean_of(const render_test::Picture& p, int first_row, int end_row) {
    double sum = 0;
    for (int y = first_row; y < end_row; ++y)
        for (int x = 0; x < p.image.width; ++x) sum += double(p.at("G", x, y));
    return sum / (p.image.width * (end_row - first_row));
}

}  // namespace plate_test
