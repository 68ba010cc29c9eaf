// SPDX-License-Identifier: Apache-2.0
// No number that is none enters a scene, whichever key it is written to; no view without a way.
// in: every numeric key of the table with NaN, infinities and too much -> out: refusals with a
// line. docs/testing.md S12, S41; docs/scene.md, section Messages.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "kernels_cpu/core/camera.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/read_scene.h"
#include "src/world/camera/view.h"

using namespace pileus;

namespace {

const char* const kText =
    "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n[sun]\n[sky]\n[ground]\n"
    "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 1], [1, 1, 2]]\n"
    "extinction_per_m = 1\nphase = { type = \"henyey-greenstein\", g = 0.5 }\n"
    "[collectors]\n[animation]\nframes = 2\n";

/// Ones, number `at` replaced by `text`; corners are lists of their own.
std::string value_with(KeyKind kind, int at, const std::string& text) {
    const int count = numbers_of(kind);
    if (count == 1) return text;
    const bool corners = kind == KeyKind::kBounds || kind == KeyKind::kRectangle;
    std::string list;
    for (int i = 0; i < count; ++i) {
        if (i > 0) list += corners && i == count / 2 ? "],[" : ",";
        list += i == at ? text : "1";
    }
    return corners ? "[[" + list + "]]" : "[" + list + "]";
}

Status read(const std::vector<std::string>& overrides, Scene& scene) {
    return read_scene_text(kText, "s.toml", "", overrides, scene);
}

}  // namespace

TEST_CASE("numbers: NaN, infinities and 1e400 are refused at every key and every place of it") {
    int tried = 0;
    for (const KeyRow* row : all_scene_keys()) {
        const int count = numbers_of(row->kind());
        std::string path = row->path;
        const std::size_t n = path.find(".N.");
        if (n != std::string::npos) path.replace(n, 3, ".0.");
        for (int at = 0; at < count; ++at)
            for (const char* text : {"nan", "-nan", "+nan", "inf", "-inf", "+inf", "1e400"}) {
                Scene scene;
                const std::string set = path + "=" + value_with(row->kind(), at, text);
                CAPTURE(set);
                const Status status = read({set}, scene);
                CHECK(status.code == Code::kBadInput);
                CHECK(status.message.find(path.substr(0, path.rfind('.'))) != std::string::npos);
                ++tried;
            }
    }
    CHECK(tried > 400);
}

TEST_CASE("S12: a camera without a direction is refused, one with a tiny arm is not bent") {
    for (const char* target : {"[0,-9,5]", "[0.0,-9.0,5.0]"}) {
        Scene scene;
        CHECK(read({std::string("camera.target_m=") + target}, scene).code == Code::kBadInput);
    }
    for (const char* up : {"[0,0,0]", "[-0.0,0,-0.0]", "[0,1,0]", "[0,-3,0]", "[0,1,1e-9]"}) {
        Scene scene;
        CHECK(read({std::string("camera.up=") + up}, scene).code == Code::kBadInput);
    }
    // Lengths whose squares leave the range of doubles: refused, or directions of length 1.
    int accepted = 0;
    for (const char* arm : {"1e-5", "1e-150", "1e-160", "1e-162", "1e-200", "1e-310", "5e-324"})
        for (const char* up : {"1", "1e-150", "1e-160", "1e-200", "5e-324", "1e9"}) {
            Scene scene;
            const std::string a = arm, u = up;
            const Status status =
                read({"camera.position_m=[0,0,0]", "camera.target_m=[" + a + "," + a + ",0]",
                      "camera.up=[0,0," + u + "]", "ground.altitude_m=-1"},
                     scene);
            CAPTURE(a);
            CAPTURE(u);
            if (!status) {
                CHECK(status.code == Code::kBadInput);
                continue;
            }
            ++accepted;
            const CameraParams c = make_camera(scene.camera, 0, {0, 0, 0});
            for (const float* v : {c.forward, c.right, c.up}) {
                const double length =
                    std::sqrt(double(v[0]) * double(v[0]) + double(v[1]) * double(v[1]) +
                              double(v[2]) * double(v[2]));
                CHECK(std::fabs(length - 1) <= 1e-6);
            }
            CHECK(double(c.forward[0]) == doctest::Approx(std::sqrt(0.5)).epsilon(1e-6));
        }
    CHECK(accepted > 0);
}
