// SPDX-License-Identifier: Apache-2.0
// Pictures that are made band by band have the bits of the whole, in memory and in a tiled file.
// in: the scenes of assets/scenes/identity -> out: equal pixels; one line for what cannot be.
// docs/program.md, "Pictures larger than memory"
#include "src/session/parts/bands.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/io/images/exr_tiles.h"
#include "src/io/images/image_file.h"
#include "src/plan/crop.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

std::size_t differing(const Image& whole, int y, const Image& band) {
    REQUIRE(band.width == whole.width);
    REQUIRE(band.channels.size() == whole.channels.size());
    std::size_t different = 0;
    for (std::size_t c = 0; c < band.channels.size(); ++c) {
        CHECK(band.channels[c].name == whole.channels[c].name);
        const std::size_t first = std::size_t(y) * std::size_t(whole.width);
        for (std::size_t i = 0; i < band.channels[c].pixels.size(); ++i)
            different += std::memcmp(&band.channels[c].pixels[i],
                                     &whole.channels[c].pixels[first + i], sizeof(float)) != 0;
    }
    return different;
}

std::string refusal(const std::vector<std::string>& set, RenderOptions options = {}) {
    const Scene scene = scene_from(kSmallCumulus, set);
    return render_bands(scene, options, 8, [](int, bool, Image&, Report&) { return Status::ok(); })
        .message;
}

}  // namespace

TEST_CASE("bands: the bits of the whole picture, in every scene of the identity set") {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator("assets/scenes/identity"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    std::size_t checked = 0;
    for (const std::string& file : files) {
        CAPTURE(file);
        Scene scene;
        REQUIRE(read_scene_file(file, {"path.target_error=0", "path.samples_per_pixel=3"}, scene));
        const bool film = scene.animation.present && scene.animation.frames > 1;
        if (film || whole_for_crop(scene) != nullptr) continue;
        Image whole;
        std::string hash;
        const Status drawn = render(scene, {}, [&](int, Image& image, Report& report) {
            whole = std::move(image);
            hash = report.hash;
            return Status::ok();
        });
        REQUIRE_MESSAGE(drawn, drawn.message);
        const int rows = 5 + int(checked % 3) * 4;
        int next = 0;
        const Status banded =
            render_bands(scene, {}, rows, [&](int y, bool last, Image& band, Report& report) {
                CHECK(y == next);
                next = y + band.height;
                CHECK(last == (next == whole.height));
                CHECK(differing(whole, y, band) == 0);
                if (last) CHECK(report.hash == hash);
                return Status::ok();
            });
        REQUIRE_MESSAGE(banded, banded.message);
        CHECK(next == whole.height);
        ++checked;
    }
    CHECK(checked >= 20);
}

TEST_CASE("bands: a tiled file has the picture, its hash and what made it") {
    const test::TempFolder folder;
    const Scene scene = scene_from(kSmallCumulus, {"camera.resolution=[29, 21]"});
    const Picture whole = render_one(scene);
    const std::string path = folder.path("tiles.exr");
    TiledExr file;
    REQUIRE(file.begin(path, 8));
    std::string hash;
    REQUIRE(render_bands(scene, {}, 8, [&](int y, bool, Image& band, Report& report) {
        hash = report.hash;
        return file.add(y, 21, band);
    }));
    CHECK_FALSE(std::filesystem::exists(path));
    REQUIRE(file.end(hash));
    Image back;
    REQUIRE(read_image(path, back));
    CHECK(back.width == 29);
    CHECK(back.height == 21);
    CHECK(back.pixel_hash == whole.report.hash);
    CHECK(pixel_hash(back) == whole.report.hash);
    CHECK(back.scene_text == scene.text);
    CHECK(back.world_to_camera == whole.image.world_to_camera);
    for (const Channel& channel : whole.image.channels) {
        const Channel* read = back.find(channel.name.c_str());
        REQUIRE(read != nullptr);
        CHECK(std::memcmp(read->pixels.data(), channel.pixels.data(), channel.pixels.bytes()) == 0);
    }
    // What is not ended leaves nothing behind.
    {
        TiledExr dropped;
        REQUIRE(dropped.begin(folder.path("dropped.exr"), 8));
    }
    CHECK_FALSE(std::filesystem::exists(folder.path("dropped.exr")));
}

TEST_CASE("bands: what needs the whole picture is refused in one line") {
    CHECK(refusal({"camera.crop=[0,0,4,4]"}).find("--tiles: together with camera.crop") == 0);
    CHECK(refusal({"animation.frames=3"}).find("--tiles: a film") == 0);
    CHECK(refusal({"collectors.display=billboards"}).find("--tiles: billboards") == 0);
    CHECK(refusal({"method.name=path", "filter.kind=regression"}).find("--tiles: a filter") == 0);
    RenderOptions timed;
    timed.budget.seconds = 1;
    CHECK(refusal({}, timed).find("--tiles: a state, an error or a time") == 0);
}
