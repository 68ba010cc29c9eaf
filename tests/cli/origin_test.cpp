// SPDX-License-Identifier: Apache-2.0
// What a picture says of its making, and that it can be made again from that.
// in: command lines -> out: attributes, keys of the report, equal hashes.
// docs/formats.md, "OpenEXR"; docs/report.md
#include <map>
#include <nlohmann/json.hpp>

#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"

using namespace pileus;
using test::ProgramFolder;

namespace {

std::map<std::string, std::string> origin_of(const Image& image) {
    return {image.origin.begin(), image.origin.end()};
}

}  // namespace

TEST_CASE("a picture and its report hold version, seed, frame, budget and overrides") {
    if (!can_write_image("a.exr")) {
        MESSAGE("skipped: no OpenEXR in this build");
        return;
    }
    const ProgramFolder folder;
    REQUIRE(folder
                .run("render s.toml -o a.exr --report r.json --seed 11 --frames 1-1 "
                     "--budget photons=600 --set animation.frames=3 "
                     "--set animation.camera_orbit_deg=[0,40] --set medium.0.albedo=0.9")
                .exit_status == 0);
    const std::string name = folder.left()[0];
    Image image;
    REQUIRE(read_image(folder.files().path(name), image));
    const std::map<std::string, std::string> origin = origin_of(image);
    const auto report = nlohmann::json::parse(folder.files().get(folder.left()[1]));
    CHECK(origin.at("version") == report["version"].get<std::string>());
    using test::holds;
    const std::string version = folder.run("--version").output;
    CHECK(holds(version, " (") == (origin.count("commit") == 1));
    if (origin.count("commit") == 1) CHECK(holds(version, " (" + origin.at("commit") + ")\n"));
    CHECK(origin.at("method") == "collectors");
    CHECK(origin.at("seed") == "11");
    CHECK(origin.at("frame") == "1");
    CHECK(origin.at("firstFrame") == "1");
    CHECK(origin.at("budget") == "photons=600");
    CHECK(origin.at("budgetUsed") == "photons=600 generations=4");
    CHECK(origin.count("interrupted") == 0);
    CHECK(origin.at("override.2") == "medium.0.albedo=0.9");
    CHECK(origin.count("threads") == 0);
    CHECK(origin.count("show") == 0);
    CHECK(report["seed"] == 11);
    CHECK(report["frame"] == 1);
    CHECK(report["first_frame"] == 1);
    CHECK(report["budget"] == "photons=600");
    CHECK(report["budget_used"] == "photons=600 generations=4");
    CHECK(report["layers"].dump() == "[\"radiance\",\"alpha\"]");
    CHECK(report["overrides"].size() >= 3);

    // The same picture from what the file says alone.
    folder.files().put("again.toml", image.scene_text);
    std::string line = "render again.toml -o b.exr --seed " + origin.at("seed") + " --frames " +
                       origin.at("firstFrame") + "-" + origin.at("frame") + " --budget " +
                       origin.at("budget");
    for (int i = 0; origin.count("override." + std::to_string(i)) > 0; ++i)
        line += " --set '" + origin.at("override." + std::to_string(i)) + "'";
    REQUIRE(folder.run(line).exit_status == 0);
    Image again;
    for (const std::string& file : folder.left())
        if (file[0] == 'b') REQUIRE(read_image(folder.files().path(file), again));
    CHECK(again.pixel_hash == image.pixel_hash);
    CHECK(!again.pixel_hash.empty());
}
