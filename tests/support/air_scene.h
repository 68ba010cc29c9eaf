// SPDX-License-Identifier: Apache-2.0
// A small scene in clear air.
// in: nothing -> out: TOML.
// docs/atmosphere.md
#pragma once
#include "tests/support/render_harness.h"

namespace air_test {

/// The small cumulus 12 km off in hazy air.
inline std::string in_air() {
    std::string text = render_test::kSmallCumulus;
    const auto put = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    put("[sky]\nradiance = [0.0625, 0.125, 0.25]", "[atmosphere]\nturbidity = 4");
    put("position_m = [16, -4000, 256]", "position_m = [16, -12000, 256]");
    put("fov_deg = 40", "fov_deg = 14");
    put("\"error\"]", "\"cloud\"]");
    return text + "[path]\nsamples_per_pixel = 512\n";
}

}  // namespace air_test
