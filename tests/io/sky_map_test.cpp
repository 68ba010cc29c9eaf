// SPDX-License-Identifier: Apache-2.0
// Sky maps from files: what is taken over, and a line for each fault.
// in: small .pfm and .exr files, some broken -> out: pass or fail.
// docs/formats.md "Sky maps in".
#include <array>
#include <cstring>
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

#ifdef PILEUS_WITH_OPENEXR
namespace {

/// The bytes of a file of one block of rows, its data window at x, y of a display of 4 x 4.
std::string moved(const Image& image, int x, int y) {
    Buffer<char> bytes;
    REQUIRE(encode_exr(image, bytes));
    std::string text(bytes.data(), bytes.size());
    const auto put = [&](std::size_t at, int value) {
        for (std::size_t i = 0; i < 4; ++i) text[at + i] = char(unsigned(value) >> (8 * i) & 255);
    };
    const auto put_box = [&](const std::string& name, const std::array<int, 4>& box) {
        const std::string key = name + std::string("\0box2i\0\x10\0\0\0", 11);
        const std::size_t at = text.find(key);
        REQUIRE(at != std::string::npos);
        for (std::size_t i = 0; i < 4; ++i) put(at + key.size() + 4 * i, box[i]);
    };
    put_box("dataWindow", {x, y, x + image.width - 1, y + image.height - 1});
    put_box("displayWindow", {0, 0, 3, 3});
    // The table of offsets has one, of the block behind it, which begins with its first row.
    for (std::size_t at = 8; at + 12 < text.size(); ++at) {
        std::uint64_t offset = 0;
        std::memcpy(&offset, &text[at], 8);
        if (offset == at + 8) put(at + 8, y);
    }
    return text;
}

}  // namespace

TEST_CASE("sky map file: the display is the sky, black where the file has no pixels") {
    const test::TempFolder folder;
    const auto value = [](int row, int column, int c) { return row * 10 + column + c * 0.5 + 1; };
    SkyMap map;
    folder.put("upper.exr", moved(sky_image(4, 2, value), 0, 0));
    REQUIRE(load(folder, "upper.exr", false, 1, map));
    CHECK(map.size == std::array<int, 2>{4, 4});
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(map.view.radiance[i] == (i < 8 ? float(i / 4 * 10 + i % 4 + 1) : 0.0f));
    // Origins may be negative, and pixels lie outside of the display.
    folder.put("off.exr", moved(sky_image(4, 2, value), -1, 3));
    REQUIRE(load(folder, "off.exr", false, 1, map));
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(map.view.radiance[i] == (i >= 12 && i < 15 ? float(i - 12 + 2) : 0.0f));
}

TEST_CASE("sky map file: layers of other programs, and what says other colours or rows") {
    const test::TempFolder folder;
    const auto value = [](int row, int column, int c) { return row * 10 + column + c * 0.5; };
    SkyMap map;
    for (const char* layer : {"rgba.", "beauty.", "ViewLayer.Combined."}) {
        Image image = sky_image(4, 2, value);
        for (Channel& channel : image.channels) channel.name = layer + channel.name;
        image.channels.emplace_back();
        image.channels.back().name = "ViewLayer.Depth.Z";
        REQUIRE(image.channels.back().pixels.resize(8, "Z"));
        REQUIRE(write_image(image, folder.path("l.exr"), {}));
        const Status status = load(folder, "l.exr", false, 1, map);
        REQUIRE_MESSAGE(status, status.message);
        CHECK(map.view.radiance[4 + 3] == 13);
        CHECK(map.view.radiance[8 * 2 + 4 + 3] == 14);
    }
    Image depth = sky_image(4, 2, value);
    depth.channels.resize(1);
    depth.channels[0].name = "Z";
    REQUIRE(write_image(depth, folder.path("z.exr"), {}));
    CHECK(holds(load(folder, "z.exr", false, 1, map).message, "channel R: missing"));

    Buffer<char> bytes;
    REQUIRE(encode_exr(sky_image(4, 2, value), bytes));
    std::string text(bytes.data(), bytes.size());
    const std::string key("chromaticities\0chromaticities\0\x20\0\0\0", 34);
    const std::size_t at = text.find(key) + key.size();
    REQUIRE(at != std::string::npos + key.size());
    const float red = 0.7347f;
    std::memcpy(&text[at], &red, 4);
    folder.put("aces.exr", text);
    CHECK(holds(load(folder, "aces.exr", false, 1, map).message,
                "aces.exr: chromaticities: red at 0.734700 0.330000, white at"));
}
#endif
