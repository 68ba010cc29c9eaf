// SPDX-License-Identifier: Apache-2.0
// Many clouds from a scene's text have the pictures of the same calls of pileus.h.
// in: small skies -> out: checks.
// docs/clouds.md, "In a scene file"
#include "src/clouds/render_clouds.h"
#include "src/clouds/scatter.h"
#include "src/scene/read_scene.h"
#include "tests/embed/clouds_harness.h"
#include "tests/io/temp_folder.h"

using namespace clouds_test;

namespace {

std::string hex(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

/// The small sky with a kind in a file of `folder`.
std::string cloudy_text(const pileus::test::TempFolder& folder, bool air) {
    folder.put("kind.toml", kSmallCumulus);
    return sky_text(air) + "[[clouds.kind]]\nname = \"c\"\nscene = \"" + folder.path("kind.toml") +
           "\"\nset = [\"method.name=raymarch\", \"raymarch.steps=40\", \"raymarch.jitter=none\"]\n"
           "[[clouds.place]]\nkind = \"c\"\noffset_m = [0, 0, 0]\n"
           "[[clouds.place]]\nkind = \"c\"\noffset_m = [2500, 9000, 200]\nyaw_deg = 90\n"
           "scale = 1.5\n"
           "[clouds.detail]\nnear_px = 16\nnear_scale = 1\n";
}

}  // namespace

TEST_CASE("clouds: a scene's text and the calls of C have one hash, frame after frame") {
    const pileus::test::TempFolder folder;
    for (const bool air : {false, true}) {
        CAPTURE(air);
        pileus::Scene scene;
        const pileus::Status read = pileus::read_scene_text(
            cloudy_text(folder, air), "sky.toml", "",
            {"camera.resolution=[48,28]", "animation.frames=3",
             "animation.keys=[{frame=0,way=\"linear\",camera_position_m=[16,-4000,256]},"
             "{frame=2,camera_position_m=[16,-3400,256]}]",
             "animation.sun_elevation_deg=[30,34]", "camera.target_m=[0,0,1024]",
             "camera.fov_deg=40", "output.layers=[depth]"},
            scene);
        REQUIRE_MESSAGE(bool(read), read.message);
        pileus::RenderOptions options;
        options.last_frame = 2;
        std::vector<std::string> hashes;
        const pileus::Status drawn = pileus::render_clouds(
            scene, options, [&](int, pileus::Image& image, pileus::Report& report) {
                hashes.push_back(image.pixel_hash);
                CHECK(report.clouds.clouds == 2);
                return pileus::Status::ok();
            });
        REQUIRE_MESSAGE(bool(drawn), drawn.message);
        REQUIRE(hashes.size() == 3);

        CloudySky c({at(0, 0, 0), at(2500, 9000, 200, 90, 1.5)}, {}, air);
        c.detail(false, 16);
        for (int frame = 0; frame < 3; ++frame) {
            const double from[3] = {16, -4000.0 + 300 * frame, 256}, to[3] = {0, 0, 1024};
            c.sky.aim(from, to, 40, 48, 28);
            c.sky.sun(scene.sun.azimuth_deg, 30 + 2 * frame);
            CHECK(hex(c.draw().hash) == hashes[std::size_t(frame)]);
        }
    }
}

TEST_CASE("clouds: the scene that comes with the program shows its clouds") {
    pileus::Scene scene;
    const pileus::Status read = pileus::read_scene_file(
        "assets/skies/many_clouds.toml",
        {"camera.resolution=[64,36]", "clouds.scatter.0.yaw_steps=1", "clouds.place.0.yaw_deg=0"},
        scene);
    REQUIRE_MESSAGE(bool(read), read.message);
    const pileus::Status drawn =
        pileus::render_clouds(scene, {}, [](int, pileus::Image& image, pileus::Report& report) {
            double alpha = 0;
            for (const float a : image.find("A")->pixels.span()) alpha += double(a) / (64 * 36);
            CHECK((alpha > 0.05 && alpha < 0.5));
            CHECK(report.clouds.clouds == 100);
            CHECK(report.clouds.visible > 10);
            CHECK(report.clouds.lit == 2);
            CHECK(report.method == "raymarch");
            return pileus::Status::ok();
        });
    REQUIRE_MESSAGE(bool(drawn), drawn.message);
    // Calls that know nothing of clouds say so.
    const pileus::Status other = pileus::render(
        scene, {}, [](int, pileus::Image&, pileus::Report&) { return pileus::Status::ok(); });
    CHECK(other.code == pileus::Code::kBadInput);
    CHECK(other.message.find("clouds.kind: many clouds") != std::string::npos);
}

TEST_CASE("clouds: those by random numbers stand apart, in their ring, and stay as more come") {
    pileus::CloudScatter scatter;
    scatter.count = 200;
    scatter.seed = 5;
    scatter.near_m = 2000;
    scatter.far_m = 50000;
    scatter.base_m = {900, 1400};
    scatter.scale = {0.5, 1.5};
    // The second kind's box lies far from its origin.
    const std::vector<pileus::KindBox> boxes{{{-800, -800, 600}, {800, 800, 1700}},
                                             {{3000, -100, 0}, {4000, 500, 900}}};
    std::vector<pileus::CloudPlace> places, more;
    REQUIRE(pileus::scatter_clouds(scatter, {{100, -200}}, {0, 1}, boxes, places));
    REQUIRE(places.size() == 200);
    std::size_t second = 0, near = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const pileus::CloudPlace& p = places[i];
        const pileus::Footprint a = pileus::footprint_of(p, boxes[p.kind]);
        const double x = a.x - 100, y = a.y + 200, away = __builtin_sqrt(x * x + y * y);
        CHECK((away > 1999.9 && away < 50000.1));
        const double base = p.offset_m.z + p.scale * boxes[p.kind].low_m.z;
        CHECK((base > 899.9 && base < 1400.1));
        CHECK((p.scale >= 0.5 && p.scale <= 1.5));
        CHECK((p.yaw_deg == 0 || p.yaw_deg == 90 || p.yaw_deg == 180 || p.yaw_deg == 270));
        second += p.kind;
        near += away < 10000 ? 1 : 0;
        for (std::size_t j = 0; j < i; ++j) {
            const pileus::Footprint b = pileus::footprint_of(places[j], boxes[places[j].kind]);
            const double dx = a.x - b.x, dy = a.y - b.y;
            CHECK(dx * dx + dy * dy > (a.radius + b.radius) * (a.radius + b.radius));
        }
    }
    // One of two kinds; within the middle of the ring by its logarithm half of them, but for those
    // that found no room there.
    CHECK((second > 70 && second < 130));
    CHECK((near > 20 && near < 100));
    scatter.count = 201;
    REQUIRE(pileus::scatter_clouds(scatter, {{100, -200}}, {0, 1}, boxes, more));
    for (std::size_t i = 0; i < places.size(); ++i) CHECK(more[i].offset_m == places[i].offset_m);
    scatter.far_m = 2500;
    const pileus::Status full = pileus::scatter_clouds(scatter, {{0, 0}}, {0, 1}, boxes, more);
    CHECK(full.code == pileus::Code::kBadInput);
    CHECK(full.message.find("allowed: fewer") != std::string::npos);
}
