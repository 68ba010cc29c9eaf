// SPDX-License-Identifier: Apache-2.0
// Sequences of density files: an animation's frames each read their own.
// in: three files of particles -> out: the pictures of each alone; faults.
// docs/particles.md, "Sequences"; docs/testing.md, label law
#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"
#include "tools/study/scene_files.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

namespace {

const char* const kRows[] = {"0 0 50 20 0.1\n", "10 0 50 20 0.1\n", "-20 0 40 30 0.05\n"};

std::string named(const std::string& file, const std::string& more = "") {
    std::string text = kText;
    text.replace(text.find("\"p.csv\""), 7, "{ file = \"" + file + "\"" + more + " }");
    return text + "\n[animation]\nframes = 3\n";
}

/// Hashes of the frames that are rendered.
Status hashes(const Scene& scene, const RenderOptions& options, std::vector<std::string>& out) {
    out.clear();
    return render(scene, options, [&](int, Image&, Report& report) {
        out.push_back(report.hash);
        return Status::ok();
    });
}

}  // namespace

TEST_CASE("sequence: frames are the pictures of their files, in every method") {
    const test::TempFolder folder;
    for (int i = 0; i < 3; ++i) {
        const std::string rows = std::string("x y z radius density\n") + kRows[i];
        folder.put("p_" + std::to_string(1009 + i) + ".csv", rows);
        folder.put("q" + std::to_string(9 + i) + ".csv", rows);
    }
    for (const char* method : {"particles", "raymarch", "collectors"}) {
        CAPTURE(method);
        const std::vector<std::string> own = {"method.name = \"" + std::string(method) + "\"",
                                              "collectors.photons = 1000",
                                              "output.layers = [\"radiance\", \"alpha\"]"};
        std::vector<std::string> alone, all;
        for (int i = 0; i < 3; ++i) {
            std::string text = kText;
            text.replace(text.find("p.csv"), 5, "p_" + std::to_string(1009 + i) + ".csv");
            Scene scene = scene_from(text, own);
            scene.directory = folder.path("");
            std::vector<std::string> one;
            REQUIRE(hashes(scene, {}, one));
            alone.push_back(one.at(0));
        }
        Scene scene = scene_from(named("p_####.csv", ", first_frame = 1009"), own);
        scene.directory = folder.path("");
        RenderOptions options;
        options.last_frame = 2;
        REQUIRE(hashes(scene, options, all));
        // Noise goes by the frame's number; the others have none.
        if (std::string(method) != "collectors") CHECK(all == alone);
        REQUIRE(all.size() == 3);
        CHECK(all[0] == alone[0]);
        CHECK(all[1] != all[0]);
        options.first_frame = options.last_frame = 2;
        std::vector<std::string> last;
        REQUIRE(hashes(scene, options, last));
        CHECK(last.at(0) == all[2]);
        // A number wider than its place.
        Scene narrow = scene_from(named("q#.csv", ", first_frame = 9"), own);
        narrow.directory = folder.path("");
        std::vector<std::string> wide;
        REQUIRE(hashes(narrow, options, wide));
        CHECK(wide.at(0) == all[2]);
    }
}

TEST_CASE("sequence: a file that is missing is named, and all are inputs") {
    const test::TempFolder folder;
    folder.put("p0.csv", std::string("x y z radius density\n") + kRows[0]);
    Scene scene = scene_from(named("p#.csv"), {});
    scene.directory = folder.path("");
    RenderOptions options;
    options.last_frame = 2;
    std::vector<std::string> all;
    const Status status = hashes(scene, options, all);
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message.find("p1.csv") != std::string::npos);
    CHECK(all.size() == 1);
    const std::vector<std::string> files = scene_files(scene);
    REQUIRE(files.size() == 3);
    CHECK(files[2] == folder.path("p2.csv"));
    Scene none;
    const Status fault = read_scene_text(named("p.csv", ", first_frame = 3"), "t", "", {}, none);
    CHECK(fault.message.find("density.first_frame: for a sequence only, 3") != std::string::npos);
    CHECK(density_path(scene_from(named("a#b/c.csv")), scene_from(named("a#b/c.csv")).media[0]) ==
          "a#b/c.csv");
}
