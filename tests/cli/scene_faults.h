// SPDX-License-Identifier: Apache-2.0
// What tests of a scene's faults share: sound lines to stand before a fault, and its whole message.
// in: scene texts -> out: checks of the message.
// docs/scene.md, section Messages.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "src/scene/read_scene.h"

namespace scene_faults {

using pileus::Code;
using pileus::Scene;
using pileus::Status;

inline const std::string kCamera = "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n";
inline const std::string kMedium =
    "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\n"
    "extinction_per_m = 1\n";
inline const std::string kFile = "[[medium]]\nextinction_per_m = 1\n";

inline Status read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Scene scene;
    return pileus::read_scene_text(text, "s.toml", "", overrides, scene);
}

/// A text and its only fault.
struct Row {
    std::string text;  // the fault stands behind sound lines
    const char* line;  // the whole message, "..." for any part of it
};

inline void check(const Row& row) {
    CAPTURE(row.text);
    const Status status = read(row.text);
    CHECK(status.code == Code::kBadInput);
    const std::string expected = row.line;
    const std::size_t dots = expected.find("...");
    if (dots == std::string::npos) {
        CHECK(status.message == expected);
        return;
    }
    const std::string end = expected.substr(dots + 3), &message = status.message;
    REQUIRE(message.size() >= dots + end.size());
    CHECK(message.substr(0, dots) == expected.substr(0, dots));
    CHECK(message.substr(message.size() - end.size()) == end);
    CHECK(std::count(message.begin(), message.end(), '\n') == 0);
}

}  // namespace scene_faults
