// SPDX-License-Identifier: Apache-2.0
// Means of pictures of a scene with meshes of the test's own, by two methods.
// in: TOML, meshes as OBJ -> out: means of three channels; raymarch against path.
#pragma once
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

namespace solid_test {

using Meshes = std::vector<std::pair<const char*, const char*>>;  ///< names of files, contents

/// Pixels [x0, x1) x [y0, y1).
struct Pixels {
    int x0, y0, x1, y1;
};

inline std::array<double, 3> means_of(const std::string& text, const Meshes& meshes,
                                      const char* method, const Pixels& of,
                                      const std::vector<std::string>& more) {
    const pileus::test::TempFolder folder;
    for (const auto& mesh : meshes) folder.put(mesh.first, mesh.second);
    std::vector<std::string> set = {std::string("method.name=") + method};
    set.insert(set.end(), more.begin(), more.end());
    pileus::Scene scene = render_test::scene_from(text, set);
    scene.directory = folder.path("");
    const render_test::Picture p = render_test::render_one(scene);
    const double pixels = double(of.x1 - of.x0) * double(of.y1 - of.y0);
    std::array<double, 3> out{};
    for (int y = of.y0; y < of.y1; ++y)
        for (int x = of.x0; x < of.x1; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                out[c] += double(p.at(c == 0 ? "R" : c == 1 ? "G" : "B", x, y)) / pixels;
    return out;
}

inline void compare_with_path(const std::string& text, const Meshes& meshes, const Pixels& of,
                              double tolerance, const std::vector<std::string>& more) {
    const std::array<double, 3> truth = means_of(text, meshes, "path", of, more);
    const std::array<double, 3> found = means_of(text, meshes, "raymarch", of, more);
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        CHECK(std::fabs(found[c] / truth[c] - 1) < tolerance);
    }
}

}  // namespace solid_test
