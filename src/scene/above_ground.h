// SPDX-License-Identifier: Apache-2.0
// Whether media stand above the ground, whoever places them: bounds and keys of a scene, files that
// know their place, hosts, skies of many clouds.
// in: the lowest height of a medium's box, the ground -> out: whether it is below, and the fault.
// docs/scene.md, "Media"
#pragma once
#include "src/base/number_text.h"
#include "src/base/status.h"
#include "src/scene/scene.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

/// `moved_m` of `lowest_m` are a shift; 0: where the box was made.
inline bool is_below_ground(const Ground& ground, double lowest_m, double moved_m) {
    // What sums of doubles round is no fault.
    constexpr double kRounding = 1e-12;
    const auto size = [](double v) { return v < 0 ? -v : v; };
    const double slack = kRounding * (size(lowest_m) + size(moved_m) + size(ground.altitude_m));
    return ground.present && lowest_m < ground.altitude_m - slack;
}

/// The words of the fault, after the key and where it was.
inline std::string below_ground_text(const Ground& ground, double lowest_m, double moved_m) {
    std::string text = "below the ground, lowest z " + number_text(lowest_m) +
                       ", allowed: at least ground.altitude_m " + number_text(ground.altitude_m);
    if (moved_m != 0)
        text +=
            ", moved up or down by at least " + number_text(moved_m + ground.altitude_m - lowest_m);
    return text;
}

}  // namespace pileus
