// SPDX-License-Identifier: Apache-2.0
// Every key of a procedural sky reaches its field.
// in: a scene with all keys -> out: pass or fail.
#include <doctest/doctest.h>

#include <string>

#include "src/base/number_text.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"

using namespace pileus;

namespace {

const char* const kEveryKey = R"(
camera = { position_m = [0, -9, 5], target_m = [0, 0, 5] }
[[medium]]
density = "procedural:sky"
bounds_m = [[0, 0, 0], [1, 1, 1]]
[medium.sky]
type = "stratus"
perlin_m = 101
worley_m = 102
scale = 1.5
blend = 0.25
gain_perlin = 2
gain_worley = 3
threshold_low = 0.125
threshold_high = 0.375
coverage = 0.75
density = 4
base_m = 500
top_m = 600
base_rise = 0.0625
top_fall = 0.1875
rounding = 0.5
base_density = 0.875
planet_radius_m = 6e6
wind_m_per_s = [5, -6]
time_s = 7
seed = 8
size = 64
perlin_cells = 9
worley_cells = 10
octaves = 2
roughness = 0.3125
evaluate = "grid"
)";

std::string dump(const SkySettings& s) {
    std::string text = s.type;
    const auto add = [&](double v) { text += " " + number_text(v); };
    for (const SkyNoise* n : {&s.perlin, &s.worley})
        add(n->tile_m), add(n->gain), add(n->cells), add(n->octaves);
    for (double v : {s.scale,           s.blend,           s.roughness,      double(s.size),
                     double(s.seed),    s.threshold_low,   s.threshold_high, s.density,
                     s.coverage,        s.base_m,          s.top_m,          s.base_rise,
                     s.top_fall,        s.rounding,        s.base_density,   s.planet_radius_m,
                     s.wind_m_per_s[0], s.wind_m_per_s[1], s.time_s,         double(s.evaluate)})
        add(v);
    return text;
}

}  // namespace

TEST_CASE("every key of a sky reaches its field") {
    Scene scene;
    const Status status = read_scene_text(kEveryKey, "s.toml", "", {}, scene);
    REQUIRE_MESSAGE(status, status.message);
    CHECK(dump(scene.media[0].sky) ==
          "stratus 101 2 9 2 102 3 10 2 1.5 0.25 0.3125 64 8 0.125 0.375 4 0.75 500 600 0.0625 "
          "0.1875 0.5 0.875 6e+06 5 -6 7 1");
}
