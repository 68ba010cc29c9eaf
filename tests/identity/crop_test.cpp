// SPDX-License-Identifier: Apache-2.0
// Parts of pictures have the bits of the whole, in every method and layer.
// in: the scenes of assets/scenes/identity, wider -> out: equal pixels.
// docs/program.md, "A part of a picture"
#include "src/plan/crop.h"

#include <algorithm>
#include <filesystem>

#include "src/clouds/render_clouds.h"
#include "src/io/images/image_file.h"
#include "src/scene/method_column.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr int kWidth = 101, kHeight = 22;

/// Windows begin in front of these and within the picture, or are all of it: one pixel in each
/// corner and the middle, one row, one column, all.
constexpr std::array<int, 4> kCrops[] = {
    {40, 9, 61, 15},  {0, 0, 1, 1},    {100, 21, 101, 22}, {64, 8, 65, 9},
    {0, 11, 101, 12}, {97, 0, 98, 22}, {0, 0, 101, 22},    {31, 3, 33, 5},
};

std::vector<Image> pictures_of(const Scene& scene) {
    std::vector<Image> images;
    const auto draw = scene.clouds.present() ? render_clouds : render;
    RenderOptions options;
    options.digests = false;
    options.last_frame = scene.animation.present ? std::min(scene.animation.frames - 1, 1) : 0;
    const Status status = draw(scene, options, [&](int, Image& image, Report&) {
        images.push_back(std::move(image));
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return images;
}

std::size_t differing(const Image& whole, const Image& part, const std::array<int, 4>& crop) {
    REQUIRE(part.width == crop[2] - crop[0]);
    REQUIRE(part.height == crop[3] - crop[1]);
    REQUIRE(part.channels.size() == whole.channels.size());
    CHECK(part.display.x == -crop[0]);
    CHECK(part.display.y == -crop[1]);
    CHECK(part.display.width == whole.width);
    CHECK(part.display.height == whole.height);
    std::size_t different = 0;
    for (std::size_t c = 0; c < part.channels.size(); ++c) {
        CHECK(part.channels[c].name == whole.channels[c].name);
        for (int y = 0; y < part.height; ++y) {
            const float* a = whole.channels[c].pixels.data() +
                             std::size_t(y + crop[1]) * std::size_t(whole.width) + crop[0];
            const float* b =
                part.channels[c].pixels.data() + std::size_t(y) * std::size_t(part.width);
            for (int x = 0; x < part.width; ++x)
                different += std::memcmp(a + x, b + x, sizeof(float)) != 0;
        }
    }
    return different;
}

Scene wide_scene(const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> set = {"camera.resolution=[101, 22]", "path.target_error=0",
                                    "path.samples_per_pixel=3", "photon_grid.photons=4000",
                                    "collectors.photons=4000"};
    set.insert(set.end(), more.begin(), more.end());
    Scene scene;
    Status read = read_scene_file(file, set, scene);
    REQUIRE_MESSAGE(read, read.message);
    return scene;
}

/// Some crops of a scene; `turn` chooses which.
void check_crops(const Scene& scene, std::size_t turn, std::size_t count) {
    const std::vector<Image> whole = pictures_of(scene);
    for (std::size_t i = 0; i < count; ++i) {
        Scene part = scene;
        part.crop = kCrops[(turn + i) % (sizeof kCrops / sizeof kCrops[0])];
        CAPTURE(part.crop[0]);
        CAPTURE(part.crop[1]);
        const std::vector<Image> cut = pictures_of(part);
        REQUIRE(cut.size() == whole.size());
        for (std::size_t f = 0; f < cut.size(); ++f) {
            CAPTURE(f);
            CHECK(differing(whole[f], cut[f], part.crop) == 0);
        }
    }
}

}  // namespace

TEST_CASE("crop: the bits of the whole picture, in every scene of the identity set") {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator("assets/scenes/identity"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    std::size_t turn = 0;
    for (const std::string& file : files) {
        CAPTURE(file);
        Scene scene = wide_scene(file, {});
        // A depth image has a size of its own.
        if (!scene.view_files.depth.empty()) continue;
        check_crops(scene, turn, 2);
        turn += 3;
    }
}

TEST_CASE("crop: every choice that looks at other pixels") {
    const struct {
        const char* file;
        std::vector<std::string> set;
    } cases[] = {
        {"raymarch", {"raymarch.scale=2"}},
        {"raymarch", {"raymarch.scale=4", "raymarch.upsample=linear"}},
        {"raymarch", {"raymarch.temporal=2"}},
        {"raymarch", {"raymarch.jitter=hash"}},
        {"raymarch", {"raymarch.jitter=blue-noise", "raymarch.spacing=optimal"}},
        {"cumulus_march", {"collectors.scale=2", "output.layers=[]"}},
        {"photon_grid", {"photon_grid.scale=4", "output.layers=[]"}},
        {"path_filter", {}},
        {"atmosphere_photons", {"atmosphere.sun_disc=true", "camera.target_m=[0,4000,2500]"}},
        {"cumulus_march", {"camera.projection=orthographic", "camera.height_m=2000"}},
        {"particles", {"particles.display=billboards"}},
    };
    for (const auto& c : cases) {
        CAPTURE(c.file);
        CAPTURE((c.set.empty() ? std::string() : c.set[0]));
        const std::string file = std::string("assets/scenes/identity/") + c.file + ".toml";
        Scene scene;
        std::vector<std::string> set = c.set;
        if (c.set.size() == 2 && c.set[0].find("orthographic") != std::string::npos) {
            // A field of view is no key of parallel rays.
            scene = wide_scene(file, {});
            scene.camera.orthographic = true;
            scene.camera.height_m = 2000;
        } else {
            scene = wide_scene(file, set);
        }
        check_crops(scene, 0, 4);
    }
}

TEST_CASE("crop: a file has the whole picture as its display window, and its hash") {
    const test::TempFolder folder;
    Scene scene = scene_from(kSmallCumulus, {"camera.crop=[3, 2, 20, 9]"});
    Picture p = render_one(scene);
    CHECK(p.report.hash == pixel_hash(p.image));
    const std::string path = folder.path("part.exr");
    REQUIRE(write_image(p.image, path, {}));
    Image back;
    REQUIRE(read_image(path, back));
    CHECK(back.width == 17);
    CHECK(back.height == 7);
    CHECK(back.display.x == -3);
    CHECK(back.display.y == -2);
    CHECK(back.display.width == 24);
    CHECK(back.display.height == 14);
    CHECK(pixel_hash(back) == p.report.hash);
}

TEST_CASE("crop: what cannot be kept is refused in one line") {
    const auto fault = [](const std::vector<std::string>& set, RenderOptions options = {}) {
        const Scene scene = scene_from(kSmallCumulus, set);
        return render(scene, options, [](int, Image&, Report&) { return Status::ok(); }).message;
    };
    CHECK(fault({"camera.crop=[0,0,4,4]", "method.name=path", "path.target_error=0.1"})
              .find("camera.crop: together with an error to reach") != std::string::npos);
    RenderOptions shows;
    shows.show = "leaves";
    CHECK(fault({"camera.crop=[0,0,4,4]"}, shows).find("--show: together with camera.crop") == 0);
    for (const char* crop : {"[4,0,4,4]", "[0,5,4,4]", "[0,0,25,4]", "[0,0,4,15]"}) {
        Scene scene;
        const Status status = read_scene_text(kSmallCumulus, "s.toml", "",
                                              {std::string("camera.crop=") + crop}, scene);
        CHECK(status.message.find("camera.crop: no part of the picture") != std::string::npos);
    }
}
