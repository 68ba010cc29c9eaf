// SPDX-License-Identifier: Apache-2.0
// The layer `occlusion` of method particles: the share of the sky that what a pixel shows does not
// see.
// in: balls, a ground -> out: pixels against closed forms. docs/particles.md, "Occlusion"
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

namespace {

Picture show(const std::string& rows, const std::vector<std::string>& overrides = {},
             const std::string& tables = "") {
    const test::TempFolder folder;
    folder.put("p.csv", "x y z radius density\n" + rows);
    std::vector<std::string> all = {
        "output.layers = [\"radiance\", \"alpha\", \"optical_depth\", \"occlusion\"]"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    Scene scene = scene_from(std::string(kText) + tables, all);
    scene.directory = folder.path("");
    return render_one(scene);
}

}  // namespace

TEST_CASE("occlusion: one ball's middle sees the same in all directions") {
    for (const char* display : {"march", "billboards"})
        for (const double density : {0.0001, 0.005, 0.02, 0.1}) {
            char row[64];
            (void)std::snprintf(row, sizeof row, "0 0 50 60 %.9g\n", density);
            // Half of the depth through the middle.
            const double seen = std::exp(-8.0 / 15 * density * 60);
            for (const char* ground : {"", "[ground]\naltitude_m = -100\n"}) {
                const Picture p =
                    show(row, {std::string("particles.display = \"") + display + '"'}, ground);
                CAPTURE(density);
                CHECK(double(p.at("occlusion", 12, 12)) == doctest::Approx(1 - seen).epsilon(1e-3));
                CHECK(double(p.at("occlusion", 12, 7)) ==
                      doctest::Approx(double(p.at("occlusion", 12, 12))).epsilon(1e-3));
                CHECK(p.at("occlusion", 0, 0) == 0);
            }
        }
}

TEST_CASE("occlusion: what is before counts by what reaches the camera") {
    // A dense ball far behind a thin one that sees all of the sky.
    const std::string thin = "0 -250 50 6 0.01\n", dense = "0 100 50 60 0.1\n";
    const Picture alone = show(dense), p = show(dense + thin);
    const double behind = double(alone.at("occlusion", 12, 12));
    const double depth = double(p.at("tau", 12, 12)) - double(alone.at("tau", 12, 12));
    const double front = 1 - std::exp(-depth);
    CHECK(front > 0.03);
    CHECK(behind > 0.8);
    CHECK(std::fabs(double(p.at("occlusion", 12, 12)) - (1 - front) * behind) < 0.005);
}

TEST_CASE("occlusion: the picture stays as it is; order and threads change no bit") {
    std::string rows, turned;
    for (std::uint32_t i = 0; i < 400; ++i) {
        char row[128];
        (void)std::snprintf(row, sizeof row, "%.9g %.9g %.9g %.9g %.9g\n", 80 * draw(i, 0) - 40,
                            80 * draw(i, 1) - 40, 100 * draw(i, 2), 4 + 10 * draw(i, 3),
                            0.02 + 0.1 * draw(i, 4));
        rows += row;
        turned = row + turned;
    }
    const Picture one = show(rows), other = show(turned);
    const Picture without =
        show(rows, {"output.layers = [\"radiance\", \"alpha\", \"optical_depth\"]"});
    double sum = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            for (const char* c : {"R", "G", "B", "A"})
                CHECK(one.at(c, x, y) == without.at(c, x, y));
            const float v = one.at("occlusion", x, y);
            CHECK(v == other.at("occlusion", x, y));
            CHECK((v >= 0 && v <= 1));
            sum += double(v);
        }
    CHECK(sum > 20);
    for (const char* isa : {"scalar", "avx2"})
        for (const int threads : {1, 3}) {
            if (kernel_table(isa) == nullptr) continue;
            RenderOptions options;
            options.isa = isa;
            options.threads = threads;
            const test::TempFolder folder;
            folder.put("p.csv", "x y z radius density\n" + rows);
            Scene scene =
                scene_from(kText, {"output.layers = [\"radiance\", \"alpha\", \"occlusion\"]"});
            scene.directory = folder.path("");
            const Picture same = render_one(scene, options);
            for (int y = 0; y < 24; ++y)
                for (int x = 0; x < 24; ++x)
                    REQUIRE(same.at("occlusion", x, y) == one.at("occlusion", x, y));
        }
}
