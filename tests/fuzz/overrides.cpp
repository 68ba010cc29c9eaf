// SPDX-License-Identifier: Apache-2.0
// Fuzz target: options --set KEY=VALUE.
// in: up to eight options, parted by zero bytes -> out: a scene, or lines that name the option.
// docs/scene.md, section Overrides
#include "src/scene/read_scene.h"
#include "tests/fuzz/target.h"

namespace {

constexpr const char* kScene =
    "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n"
    "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\n"
    "extinction_per_m = 1\nphase = { type = \"henyey-greenstein\", g = 0.5 }\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMost = 8;
    std::vector<std::string> options(1);
    for (std::size_t i = 0; i < size; ++i) {
        if (data[i] != 0)
            options.back() += char(data[i]);
        else if (options.size() < kMost)
            options.emplace_back();
    }
    pileus::Scene scene;
    const pileus::Status status = pileus::read_scene_text(kScene, "s.toml", "", options, scene);
    if (!status) fuzz::check_fault(status, "", false);
    return 0;
}
