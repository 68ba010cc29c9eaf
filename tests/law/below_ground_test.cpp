// SPDX-License-Identifier: Apache-2.0
// Media stand above the ground, whatever places them: bounds, keys at any frame, files that know
// their place.
// in: small scenes -> out: one line with the frame, the place and what is allowed.
// docs/scene.md, "Media"; docs/animation.md
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

const std::string kHead =
    "[camera]\nposition_m = [0, -2000, 500]\ntarget_m = [0, 0, 500]\nresolution = [6, 4]\n[sun]\n"
    "[method]\nname = \"raymarch\"\n";

std::string boxed(const std::string& ground) {
    return kHead + ground +
           "[[medium]]\ndensity = \"uniform:ellipsoid\"\nextinction_per_m = 0.01\n"
           "resolution = [8, 8, 8]\nbounds_m = [[-300, -300, 200], [300, 300, 800]]\n";
}
std::string keys(const std::string& list, int frames = 9) {
    return "[animation]\nframes = " + std::to_string(frames) + "\nkeys = [" + list + "]\n";
}
std::string at(int frame, double z, const char* more = "") {
    return "{frame = " + std::to_string(frame) + ", media_offset_m = [0, 0, " + std::to_string(z) +
           "]" + more + "}, ";
}

Status read(const std::string& text) {
    Scene scene;
    return read_scene_text(text, "s.toml", "", {}, scene);
}
/// As the program draws it; counts pictures.
Status draw(const Scene& scene, int& pictures, int last = 0) {
    RenderOptions options;
    options.last_frame = last;
    pictures = 0;
    return render(scene, options, [&](int, Image&, Report&) {
        ++pictures;
        return Status::ok();
    });
}

void refused(const Status& status, const std::string& words) {
    CHECK(status.code == Code::kBadInput);
    CHECK_MESSAGE(status.message.find(words) != std::string::npos, status.message);
    CHECK_MESSAGE(status.message.find('\n') == std::string::npos, status.message);
}

const std::string kGround = "[ground]\naltitude_m = 0\n";

}  // namespace

TEST_CASE("below the ground: keys of a medium with bounds are refused when the scene is read") {
    refused(read(boxed(kGround) + keys(at(0, -900), 1)),
            "s.toml:17:8: animation.keys: frame 0, the media are below the ground, lowest z -700, "
            "allowed: at least ground.altitude_m 0, moved up or down by at least -200");
    // Turned about the vertical axis a box is as low as before.
    refused(read(boxed(kGround) + keys(at(0, 0) + at(4, -200.5, ", media_yaw_deg = 30"))),
            "animation.keys: frame 4, the media are below the ground, lowest z -0.5");
    // Between two keys that are above it a smooth way may lead below.
    refused(read(boxed(kGround) + keys(at(0, -100) + at(4, -199) + at(8, -199))), "frame 5, ");
    refused(read(boxed("[ground]\naltitude_m = 150\n") + keys(at(8, -51))),
            "lowest z 149, allowed: at least ground.altitude_m 150, moved up or down by at least "
            "-50");
    CHECK(read(boxed(kGround) + keys(at(0, -200) + at(8, 300))));
    CHECK(read(boxed("[ground]\naltitude_m = -800\n") + keys(at(0, -1000))));
    // Without a ground there is none to be below.
    CHECK(read(boxed("") + keys(at(0, -900))));
    // What a program filled in is checked as a text is.
    Scene scene = scene_from(boxed(kGround) + keys(at(0, 0)));
    scene.animation.keys[0].numbers[13] = -900;
    refused(check_scene(scene), "animation.keys: frame 0, the media are below the ground");
}

TEST_CASE("below the ground: files that know their place, at rest and where keys move them") {
    const test::TempFolder folder;
    folder.put("p.csv", "x,y,z,radius,density\n0,0,100,150,0.01\n50,0,300,50,0.01\n");
    const std::string text = kHead + "[[medium]]\ndensity = \"p.csv\"\n";
    int pictures = 0;
    for (const char* method : {"particles", "raymarch", "path", "collectors", "photon-grid"}) {
        CAPTURE(method);
        const auto scene_of = [&](const std::string& more) {
            Scene scene = scene_from(text + more, {std::string("method.name=") + method});
            scene.directory = folder.path("");
            return scene;
        };
        refused(draw(scene_of(kGround), pictures),
                "below the ground, lowest z -50, allowed: at least ground.altitude_m 0");
        refused(draw(scene_of(kGround + keys(at(0, 60) + at(4, 40) + at(8, 60))), pictures, 8),
                "animation.keys: frame 2, the media are below the ground, lowest z -2.5, ");
        CHECK(pictures == 0);
    }
    const auto lifted = [&](const std::string& more) {
        Scene scene = scene_from(text + more);
        scene.directory = folder.path("");
        return scene;
    };
    CHECK(draw(lifted(""), pictures));
    CHECK(draw(lifted("[ground]\naltitude_m = -50\n"), pictures));
    CHECK(draw(lifted(kGround + keys(at(0, 50))), pictures));
    CHECK(pictures == 1);
}
