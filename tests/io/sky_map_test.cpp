// SPDX-License-Identifier: Apache-2.0
// Sky maps from files: what is taken over, and a line for each fault.
// in: small .pfm and .exr files, some broken -> out: pass or fail.
// docs/formats.md "Sky maps in".
#include <limits>

#include "src/io/images/image_file.h"
#include "tests/io/temp_folder.h"
#include "tests/support/sky_images.h"

using namespace pileus;
using sky_test::sky_image;
using test::holds;

namespace {

Status load(const test::TempFolder& folder, const char* name, bool ground, double scale,
            SkyMap& map) {
    Scene scene;
    scene.view_files.sky_map = folder.path(name);
    scene.sky.map_scale = scale;
    scene.ground.present = ground;
    return load_sky_map(scene, map);
}

}  // namespace

TEST_CASE("sky map file: values, scale, grey and colour, rows above the horizon") {
    const test::TempFolder folder;
    const auto value = [](int row, int column, int c) { return row * 10 + column + c * 0.5; };
    for (const char* name : {"a.pfm", "a.exr"}) {
        if (!can_write_image(name)) continue;
        REQUIRE(write_image(sky_image(4, 3, value), folder.path(name), {}));
        SkyMap map;
        REQUIRE(load(folder, name, false, 2, map));
        CHECK(map.view.rows == 3);
        CHECK(map.view.columns == 4);
        CHECK(map.view.planes == 3);
        CHECK(map.view.radiance[0] == 0);
        CHECK(map.view.radiance[4 + 3] == 26);
        CHECK(map.view.radiance[12 * 2 + 2 * 4 + 1] == 2 * (21 + 1));
        // Three rows: the horizon cuts the middle one.
        REQUIRE(load(folder, name, true, 1, map));
        CHECK(map.view.rows == 2);
        CHECK(map.view.foot == 1.5f);
        CHECK(map.view.radiance[8] == 0.5f);
    }
    REQUIRE(write_image(sky_image(2, 1, [](int, int column, int) { return 1.0 + column; }),
                        folder.path("g.pfm"), {}));
    SkyMap map;
    REQUIRE(load(folder, "g.pfm", false, 1, map));
    CHECK(map.view.planes == 1);
    CHECK(map.radiance.size() == 2);
    CHECK(!load_sky_map(Scene{}, map).message.size());
    CHECK(!map.present());
}

TEST_CASE("sky map file: each fault has its line") {
    const test::TempFolder folder;
    const double inf = std::numeric_limits<double>::infinity();
    const struct {
        const char* name;
        double value, scale;
        const char* line;
    } rows[] = {
        {"negative.pfm", -0.5, 1, ": pixel 2 1: G: no radiance, -0.5, allowed: 0 to 1e30 after"},
        {"infinite.pfm", inf, 1, ": pixel 2 1: G: no radiance, inf, allowed: 0 to 1e30 after"},
        {"nan.pfm", std::nan(""), 1, ": pixel 2 1: G: no radiance, nan, allowed: 0 to 1e30"},
        {"large.pfm", 1e20, 1e11,
         ": pixel 2 1: G: no radiance, 100000002004087734272, allowed: 0 to 1e30"},
    };
    SkyMap map;
    for (const auto& row : rows) {
        const auto value = [&](int y, int x, int c) {
            return y == 1 && x == 2 && c == 1 ? row.value : 0.25;
        };
        REQUIRE(write_image(sky_image(4, 2, value), folder.path(row.name), {}));
        const Status status = load(folder, row.name, false, row.scale, map);
        CHECK(status.code == Code::kBadInput);
        CHECK_MESSAGE(holds(status.message, row.name + std::string(row.line)), status.message);
    }
    CHECK(load(folder, "none.pfm", false, 1, map).code == Code::kBadInput);
    // A header alone cannot make the program take memory.
    folder.put("wide.pfm", "PF\n32768 4096\n-1\n");
    const Status wide = load(folder, "wide.pfm", false, 1, map);
    CHECK(wide.code == Code::kLimit);
    CHECK_MESSAGE(holds(wide.message, "and 67108864 pixels"), wide.message);
    folder.put("short.pfm", "PF\n4096 2048\n-1\n1234");
    CHECK(load(folder, "short.pfm", false, 1, map).code == Code::kBadInput);
    // Channels of other names are no colours.
    Image depth = sky_image(2, 2, [](int, int, int) { return 1.0; });
    depth.channels[0].name = "Z";
    Sky sky;
    const Status colourless = make_sky_map("z.exr", depth, sky, false, map);
    CHECK(colourless.code == Code::kBadInput);
    CHECK(holds(colourless.message, "z.exr: "));
}
