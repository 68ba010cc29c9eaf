// SPDX-License-Identifier: Apache-2.0
// Any range of frames of a film has the bits that they have in all of it.
// in: small films by every method that keeps something from frame to frame -> out: equal hashes.
// docs/farm.md, "A film"
#include "src/clouds/render_clouds.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

/// Either side of where a film begins anew.
constexpr int kRanges[][2] = {{3, 4}, {15, 16}, {16, 17}, {17, 18}};

std::vector<std::string> hashes_of(const Scene& scene, int first, int last) {
    std::vector<std::string> hashes;
    RenderOptions options;
    options.digests = false;
    options.first_frame = first;
    options.last_frame = last;
    const auto draw = scene.clouds.present() ? render_clouds : render;
    const Status status = draw(scene, options, [&](int frame, Image& image, Report&) {
        CHECK(frame == first + int(hashes.size()));
        hashes.push_back(image.pixel_hash);
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return hashes;
}

void check_ranges(const Scene& scene) {
    const int last = scene.animation.frames - 1;
    const std::vector<std::string> all = hashes_of(scene, 0, last);
    REQUIRE(all.size() == std::size_t(last + 1));
    CHECK(all[2] != all[3]);
    for (const auto& range : kRanges) {
        if (range[1] > last) continue;
        CAPTURE(range[0]);
        const std::vector<std::string> part = hashes_of(scene, range[0], range[1]);
        REQUIRE(part.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) CHECK(part[i] == all[std::size_t(range[0]) + i]);
    }
}

const std::vector<std::string> kMoving{"animation.frames=19", "animation.camera_orbit_deg=[0, 9]",
                                       "animation.sun_elevation_deg=[35, 37]",
                                       "camera.resolution=[21, 13]", "output.layers=[]"};

}  // namespace

TEST_CASE("films: a range of frames has the bits of the whole, whatever pictures are kept") {
    const struct {
        const char* method;
        std::vector<std::string> set;
    } films[] = {
        {"raymarch", {}},
        {"raymarch", {"raymarch.temporal=2"}},
        {"raymarch", {"raymarch.temporal=4", "raymarch.light_refresh=4"}},
        {"raymarch",
         {"raymarch.temporal=2", "raymarch.light_refresh=8", "raymarch.scattering=octaves"}},
        {"optical-depth", {}},
        {"particles",
         {"particles.scattering=ordinates", "medium.0.density=procedural:particle-cumulus"}},
        {"collectors", {"collectors.photons=200", "collectors.samples=100"}},
        {"collectors",
         {"collectors.photons=200", "collectors.samples=100", "collectors.temporal=2",
          "collectors.light_refresh=4"}},
        {"photon-grid", {"photon_grid.photons=200", "photon_grid.temporal=4"}},
        {"path", {"path.samples_per_pixel=1"}},
    };
    for (const auto& film : films) {
        CAPTURE(film.method);
        CAPTURE((film.set.empty() ? std::string() : film.set[0]));
        std::vector<std::string> set = kMoving;
        set.push_back(std::string("method.name=") + film.method);
        set.insert(set.end(), film.set.begin(), film.set.end());
        check_ranges(scene_from(kSmallCumulus, set));
    }
}

TEST_CASE("films: skies of many clouds and of layers, too") {
    const test::TempFolder folder;
    folder.put("kind.toml", kSmallCumulus);
    const std::string around =
        "[camera]\nposition_m = [16, -4000, 256]\ntarget_m = [0, 0, 1024]\nfov_deg = 40\n"
        "[sun]\nazimuth_deg = 120\nelevation_deg = 35\n"
        "[ground]\naltitude_m = 0\nalbedo = 0.25\n";
    for (const bool air : {false, true}) {
        CAPTURE(air);
        std::vector<std::string> set = kMoving;
        set[1] =
            "animation.keys=[{frame=0,way=\"linear\",camera_position_m=[16,-4000,256]},"
            "{frame=18,camera_position_m=[16,-2200,256]}]";
        set.push_back("clouds.detail.near_px=5");
        check_ranges(scene_from(
            around + (air ? "[atmosphere]\nturbidity = 2.5\n" : "[sky]\nradiance = 0.1\n") +
                "[[clouds.kind]]\nname = \"c\"\nscene = \"" + folder.path("kind.toml") +
                "\"\nset = [\"method.name=raymarch\", \"raymarch.steps=16\"]\n" +
                "[[clouds.kind]]\nname = \"p\"\nscene = \"" + folder.path("kind.toml") +
                "\"\nset = [\"method.name=photon-grid\", \"photon_grid.photons=500\"]\n" +
                "[[clouds.place]]\nkind = \"c\"\noffset_m = [0, 0, 0]\n"
                "[[clouds.place]]\nkind = \"c\"\n"
                "offset_m = [2500, 9000, 200]\nyaw_deg = 90\nscale = 1.5\n"
                "[[clouds.place]]\nkind = \"p\"\noffset_m = [-2500, 9000, 200]\n",
            set));
    }
    Scene layer;
    const Status read =
        read_scene_file("assets/scenes/sky_palenik.toml",
                        {"animation.frames=5", "animation.sun_elevation_deg=[35, 37]",
                         "camera.resolution=[21, 13]", "output.layers=[]"},
                        layer);
    REQUIRE_MESSAGE(read, read.message);
    check_ranges(layer);
}
