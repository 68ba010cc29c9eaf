// SPDX-License-Identifier: Apache-2.0
// Clouds of a test's own words, made on grids of its own.
// in: keys of medium.0.cloud -> out: settings, densities, their digests, faults.
#pragma once
#include <doctest/doctest.h>

#include <string>

#include "src/base/digest.h"
#include "src/scene/read_scene.h"
#include "src/world/density/cloud.h"

namespace cloud_test {

using namespace pileus;
using Size = std::array<int, 3>;

inline std::string text_of(const std::string& cloud, const std::string& lines = "") {
    return "[camera]\nposition_m = [0, -90000, 5000]\ntarget_m = [0, 0, 5000]\n[[medium]]\n"
           "density = \"procedural:cloud\"\ncloud = { " +
           cloud + " }\n" + lines;
}

inline MediumSettings medium_of(const std::string& cloud, const std::string& lines = "") {
    Scene scene;
    const Status status = read_scene_text(text_of(cloud, lines), "s.toml", "", {}, scene);
    REQUIRE_MESSAGE(bool(status), status.message);
    return scene.media[0];
}

inline std::string fault(const std::string& cloud, const std::string& lines = "") {
    Scene scene;
    return read_scene_text(text_of(cloud, lines), "s.toml", "", {}, scene).message;
}

/// `threads`: 0: all; `all_balls`: no list of balls is shortened.
inline Volume made(const MediumSettings& medium, const Size& size, const char* isa = nullptr,
                   int threads = 0, bool all_balls = false) {
    Volume volume;
    const Status status =
        make_cloud(medium, {size, *kernel_table(isa), threads, all_balls}, volume);
    REQUIRE_MESSAGE(bool(status), status.message);
    return volume;
}

inline std::string digest(const Volume& volume) {
    Digest digest;
    digest.floats(volume.density.span());
    return digest.hex();
}

}  // namespace cloud_test
