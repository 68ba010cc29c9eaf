// SPDX-License-Identifier: Apache-2.0
// Every key of a procedural sky reaches its field, and defaults in the table are the struct's.
// in: a scene with all keys -> out: pass or fail.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "src/scene/check_keys.h"
#include "src/scene/read_scene.h"
#include "tests/support/scene_dump.h"

using namespace pileus;
using test::dump;

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

}  // namespace

TEST_CASE("every key of a sky reaches its field") {
    Scene scene;
    const Status status = read_scene_text(kEveryKey, "s.toml", "", {}, scene);
    REQUIRE_MESSAGE(status, status.message);
    CHECK(
        dump(scene.media[0].sky) ==
        "{\"stratus\" {101 2 9 2 }\n{102 3 10 2 }\n1.5 0.25 0.3125 64 8 0.125 0.375 4 0.75 500 600 "
        "0.0625 0.1875 0.5 0.875 6000000 [5 -6 ] 7 1 }\n");
    const std::string text = kEveryKey;
    for (const KeyRow& row : sky_keys()) {
        const std::string name = std::string(row.path).substr(sizeof "medium.N.sky." - 1);
        CHECK_MESSAGE(text.find("\n" + name + " = ") != std::string::npos, name);
    }
}

TEST_CASE("the defaults of a sky's keys are those of the struct") {
    int compared = 0;
    for (const KeyRow& row : sky_keys()) {
        const std::string fallback = row.fallback;
        if (fallback.empty()) continue;
        CAPTURE(row.path);
        Node root;
        SyntaxFault fault;
        REQUIRE(parse_toml("v = " + fallback, root, fault));
        Scene scene;
        MediumSettings medium;
        SolidSettings solid;
        row.set(root.children[0], {scene, medium, solid});
        CHECK(dump(medium.sky) == dump(SkySettings()));
        ++compared;
    }
    CHECK(compared == 15);
}
