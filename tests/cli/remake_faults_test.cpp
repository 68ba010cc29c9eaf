// SPDX-License-Identifier: Apache-2.0
// Pictures in place of scenes that lack a file or an attribute, or hold a wrong one.
// in: PILEUS_PROGRAM, pictures moved and damaged -> out: pass or fail.
// docs/program.md, "A picture made again"
#include "tests/cli/remake_checks.h"
#include "tests/io/test_image.h"

using namespace pileus;
using test::check_refused;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;
namespace fs = std::filesystem;

namespace {

const char* const kGrid =
    "Volume \"volumegrid\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 2 "
    "\"point p0\" [-50 -50 0] \"point p1\" [50 50 100] \"float density\" [ 1 0.5 ]\n";

/// A folder with scenes/cloud.toml that reads a file beside it.
void put_cloud(const ProgramFolder& folder) {
    fs::create_directory(folder.files().path("scenes"));
    folder.files().put("scenes/grid.pbrt", kGrid);
    std::string scene = test::small_scene();
    const std::string box = "\"uniform:box\"\nbounds_m = [[-50, -50, 0], [50, 50, 100]]";
    scene.replace(scene.find(box), box.size(), "\"grid.pbrt\"");
    folder.files().put("scenes/cloud.toml", scene + "[output]\nfiles = [\"pictures/own.exr\"]\n");
}

std::string attribute(const ProgramFolder& folder, const std::string& file,
                      const std::string& name) {
    Image image;
    REQUIRE(read_image(folder.files().path(file), image));
    for (const auto& [known, text] : image.origin)
        if (known == name) return text;
    return "none";
}

/// a.exr with another text in one attribute, as b.exr; no text: without it.
void put_damaged(const ProgramFolder& folder, const std::string& name, const std::string& text) {
    Image image;
    REQUIRE(read_image(folder.files().path("a.exr"), image));
    std::vector<std::pair<std::string, std::string>> kept;
    for (const auto& attribute : image.origin)
        if (attribute.first != name) kept.push_back(attribute);
    if (!text.empty()) kept.emplace_back(name, text);
    image.origin = kept;
    REQUIRE(write_image(image, folder.files().path("b.exr"), {}));
}

}  // namespace

TEST_CASE("remake: names in the scene start where it lay, seen from the picture") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    put_cloud(folder);
    const auto made = [&](const std::string& arguments) {
        const Outcome outcome = folder.run("render " + arguments + " -q");
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    };
    made("scenes/cloud.toml");
    CHECK(attribute(folder, "scenes/pictures/own.exr", "folder") == "..");
    made("scenes/cloud.toml -o a.exr out/deep/b.exr scenes/c.exr");
    CHECK(attribute(folder, "a.exr", "folder") == "scenes");
    CHECK(attribute(folder, "out/deep/b.exr", "folder") == "../../scenes");
    CHECK(attribute(folder, "scenes/c.exr", "folder") == ".");
    made("$PWD/scenes/cloud.toml -o $PWD/scenes/x/d.exr");
    CHECK(attribute(folder, "scenes/x/d.exr", "folder") == "..");
    for (const char* name : {"scenes/pictures/own.exr", "a.exr", "out/deep/b.exr", "scenes/c.exr",
                             "$PWD/scenes/c.exr", "scenes/x/d.exr"})
        made(name);
    // Where both are moved together.
    fs::create_directory(folder.files().path("moved"));
    fs::rename(folder.files().path("scenes"), folder.files().path("moved/set"));
    made("moved/set/pictures/own.exr");
    made("a.exr --folder moved/set");
    made("a.exr --folder $PWD/moved/set/../set");
    made("a.exr --folder moved/set -o again.exr");
    CHECK(attribute(folder, "again.exr", "folder") == "moved/set");
}

TEST_CASE("remake: no name of a folder above both is in a picture") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    put_cloud(folder);
    const std::string above = fs::path(folder.files().path("")).parent_path().filename().string();
    for (const char* arguments :
         {"$PWD/scenes/cloud.toml -o a.exr", "scenes/cloud.toml -o $PWD/a.exr",
          "$PWD/scenes/cloud.toml -o $PWD/out/a.exr", "scenes/cloud.toml -o ../%/a.exr",
          "../%/scenes/cloud.toml -o a.exr", "../%/scenes/cloud.toml -o ../%/a.exr"}) {
        std::string line = arguments;
        for (std::size_t at; (at = line.find('%')) != std::string::npos;)
            line.replace(at, 1, above);
        CAPTURE(line);
        const Outcome outcome = folder.run("render " + line + " -q");
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        const std::string name = holds(line, "out/") ? "out/a.exr" : "a.exr";
        const bool typed = line.rfind("../", 0) == 0;  // the user's own way there
        const std::string way = !typed                  ? "none"
                                : holds(line, "-o ../") ? "scenes"
                                                        : "../" + above + "/scenes";
        CHECK(attribute(folder, name, "folder") == way);
        CHECK(folder.run("render " + name + " -q --folder scenes").exit_status == 0);
    }
}

TEST_CASE("remake: a file that is missing is named, with the way to say where it is") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    put_cloud(folder);
    REQUIRE(folder.run("render scenes/cloud.toml -q -o a.exr").exit_status == 0);
    const std::string allowed = ": no such file, allowed: --folder, the folder that names in the";
    fs::rename(folder.files().path("scenes"), folder.files().path("other"));
    check_refused(folder, "render a.exr", "a.exr: needs scenes/grid.pbrt" + allowed);
    check_refused(folder, "plan a.exr", "a.exr: needs scenes/grid.pbrt" + allowed);
    check_refused(folder, "render a.exr --folder .", "a.exr: needs ./grid.pbrt" + allowed);
    check_refused(folder, "render a.exr --folder none", "--folder: no such folder, \"none\"");
    check_refused(folder, "render a.exr --folder ''", "--folder: no such folder, \"\"");
    check_refused(folder, "render s.toml -o b.exr --folder other",
                  "--folder: \"s.toml\" is no picture, allowed: with an .exr file");
    CHECK(folder.run("render a.exr --folder other").exit_status == 0);
    // The file is another one now.
    folder.files().put("other/grid.pbrt",
                       std::string(kGrid).replace(std::string(kGrid).find("0.5"), 3, "0.7"));
    CHECK(folder.run("render a.exr --folder other").exit_status == 1);
}

TEST_CASE("remake: of a sequence the picture's frame alone is needed") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    put_cloud(folder);
    for (const char* name : {"scenes/g1.pbrt", "scenes/g2.pbrt", "scenes/g3.pbrt"})
        folder.files().put(name, kGrid);
    REQUIRE(folder
                .run("render scenes/cloud.toml -q -o a.exr --set animation.frames=3 "
                     "--set 'medium.0.density={file=\"g#.pbrt\", first_frame=1}'")
                .exit_status == 0);
    for (const char* name : {"scenes/g1.pbrt", "scenes/g3.pbrt"})
        fs::remove(folder.files().path(name));
    CHECK(folder.run("render a.0001.exr").exit_status == 0);
    check_refused(folder, "render a.0002.exr", "a.0002.exr: needs scenes/g3.pbrt: no such file");
}

TEST_CASE("remake: pictures without a scene, and damaged ones, are refused with a line, exit 2") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    Image image = test::make_image(2, 2);
    image.scene_text.clear();
    REQUIRE(write_image(image, folder.files().path("plain.exr"), {}));
    check_refused(folder, "render plain.exr -o c.exr",
                  "plain.exr: pileus.scene: missing, allowed: a");
    image.scene_text = "seed = 7\n";
    image.pixel_hash = "no";
    REQUIRE(write_image(image, folder.files().path("plain.exr"), {}));
    check_refused(folder, "render plain.exr -o c.exr", "plain.exr: pileus.pixelHash: missing");
    check_refused(folder, "render none.exr -o c.exr", "none.exr: cannot read: no such file");
    folder.files().put("text.exr", "no picture");
    check_refused(folder, "render text.exr -o c.exr", "text.exr: ");
    check_refused(folder, "render a\x01.exr -o c.exr", "");

    REQUIRE(folder.run("render s.toml -q -o a.exr --budget photons=500 --set seed=3").exit_status ==
            0);
    struct Damage {
        const char *name, *text, *said;
    };
    for (const Damage& d : {
             Damage{"version", "", "b.exr: pileus.version: missing, allowed: a picture that"},
             Damage{"seed", "", "b.exr: pileus.seed: missing"},
             Damage{"seed", "-1",
                    "b.exr: pileus.seed: no such whole number, \"-1\", allowed: 0 to "},
             Damage{"frame", "1e99", "b.exr: pileus.frame: no such whole number"},
             Damage{"frame", "2", "b.exr: pileus.frame: 2, allowed: 0 to 0, or --frames"},
             Damage{"firstFrame", "1", "b.exr: pileus.firstFrame: no such whole number, \"1\""},
             Damage{"budget", "luck=1", "b.exr: pileus.budget: --budget: unknown kind, \"luck=1\""},
             Damage{"budget", "photons=x", "b.exr: pileus.budget: --budget photons: no such whole"},
             Damage{"budget", "samples=4", "--budget samples: not for method collectors"},
             Damage{"show", "nothing", "--show: "},
             Damage{"override.0", "sed=3", "sed"},
             Damage{"folder", "/etc",
                    "b.exr: pileus.folder: no relative folder, \"/etc\", allowed"},
         }) {
        CAPTURE(d.name);
        put_damaged(folder, d.name, d.text);
        check_refused(folder, "render b.exr -o c.exr", d.said);
    }
    // Two faults, two lines.
    put_damaged(folder, "seed", "x");
    fs::rename(folder.files().path("b.exr"), folder.files().path("a.exr"));
    put_damaged(folder, "frame", "x");
    CHECK(line_count(folder.run("render b.exr -o c.exr").errors) == 2);
}

TEST_CASE("remake: a run that no budget repeats says so, and goes on with another") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    REQUIRE(folder.run("render s.toml -q -o a.exr").exit_status == 0);
    Image image;
    REQUIRE(read_image(folder.files().path("a.exr"), image));
    const auto put = [&](std::vector<std::pair<std::string, std::string>> more,
                         const std::string& left_out) {
        Image other;
        REQUIRE(read_image(folder.files().path("a.exr"), other));
        other.origin.clear();
        for (const auto& attribute : image.origin)
            if (attribute.first != left_out) other.origin.push_back(attribute);
        for (const auto& attribute : more) other.origin.push_back(attribute);
        REQUIRE(write_image(other, folder.files().path("b.exr"), {}));
    };
    put({{"interrupted", "true"}}, "budgetUsed");
    check_refused(
        folder, "render b.exr -o c.exr",
        "b.exr: cannot be made again, the user ended its run within a pass or generation, "
        "allowed: --budget");
    CHECK(folder.run("render b.exr -o c.exr --budget photons=100").exit_status == 0);
    put({{"budget", "seconds=3"}}, "budgetUsed");
    check_refused(folder, "render b.exr -o c.exr",
                  "b.exr: cannot be made again, it does not say what its budget came to");
    // A march that had fewer pixels by a method without such a key.
    REQUIRE(folder
                .run("render s.toml -q -o a.exr --set method.name=optical-depth "
                     "--budget seconds=1000")
                .exit_status == 0);
    put_damaged(folder, "scale", "4");
    check_refused(folder, "render b.exr -o c.exr", "no key of optical-depth says");
    // Frames of a march that remember others, each of which a time chose.
    REQUIRE(folder
                .run("render s.toml -q -o e.exr --set method.name=raymarch --budget seconds=0.5 "
                     "--set animation.frames=3 --set raymarch.temporal=2")
                .exit_status == 0);
    check_refused(folder, "render e.0002.exr -o c.exr",
                  "e.0002.exr: cannot be made again, it depends on frames before it that a time");
    CHECK(folder.run("render e.0000.exr").exit_status == 0);
}

TEST_CASE("remake: info tells what a picture says of its run") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    REQUIRE(
        folder.run("render s.toml -q -o a.exr --seed 9 --set medium.0.albedo=0.9").exit_status ==
        0);
    const std::string lines = folder.run("info a.exr").output;
    CHECK(holds(lines, "seed           9\n"));
    CHECK(holds(lines, "override.0     medium.0.albedo=0.9\n"));
    CHECK(holds(lines, "budgetUsed     photons=1000 generations=4\n"));
    const Outcome scene = folder.run("info a.exr --scene");
    CHECK(scene.output == std::string(test::small_scene()) + "\n# --set medium.0.albedo=0.9\n");
    folder.files().put("again.toml", scene.output);
    CHECK(folder.run("render again.toml -q -o b.exr --seed 9 --set medium.0.albedo=0.9")
              .output.substr(0, 16) == folder.run("hash a.exr").output.substr(0, 16));
    check_refused(folder, "info s.toml --scene", "--scene: of a picture, allowed: a file in .exr");
    check_refused(folder, "info --scene", "--scene: no file, nothing, allowed: a picture");
    Image image = test::make_image(2, 2);
    image.scene_text.clear();
    REQUIRE(write_image(image, folder.files().path("plain.exr"), {}));
    check_refused(folder, "info plain.exr --scene", "plain.exr: pileus.scene: missing");
    image.scene_text = "seed = \x1b[31m7\n";
    REQUIRE(write_image(image, folder.files().path("plain.exr"), {}));
    CHECK(folder.run("info plain.exr --scene").output == "seed = \\x1b[31m7\n");
}
