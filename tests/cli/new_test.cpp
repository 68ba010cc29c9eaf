// SPDX-License-Identifier: Apache-2.0
// pileus new: each type's scene renders as it is, without a warning; nothing is written over.
// in: PILEUS_PROGRAM -> out: pass or fail.
// docs/program.md, "new"
#include <sstream>

#include "src/io/images/image_file.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/media/cloud_types.h"
#include "src/scene/read_scene.h"
#include "tests/cli/run_program.h"
#include "tests/support/long_tests.h"

using namespace pileus;
using test::check_refused;
using test::holds;
using test::Outcome;
using test::ProgramFolder;

namespace {

using Names = std::vector<std::string>;

/// First words of the lines of `pileus new`, but for the last, which stands for files.
Names types(const ProgramFolder& folder) {
    const Outcome list = folder.run("new");
    REQUIRE(list.exit_status == 0);
    Names names;
    std::istringstream lines(list.output);
    for (std::string line; std::getline(lines, line);)
        names.push_back(line.substr(0, line.find(' ')));
    REQUIRE(names.back() == "FILE");
    names.pop_back();
    return names;
}

}  // namespace

TEST_CASE("new: every type's scene renders as it is, without a warning") {
    const ProgramFolder folder;
    const Names all = types(folder);
    CHECK(all.size() >= 14);
    for (std::string_view cloud : split_list(kCloudTypes))
        CHECK_MESSAGE(std::count(all.begin(), all.end(), std::string(cloud)) == 1,
                      std::string(cloud));
    const bool exr = bool(can_write_image("a.exr")), png = bool(can_write_image("a.png"));
    // All are read and planned; in the short form a few are rendered.
    const std::size_t stride = row_stride(4);
    for (std::size_t number = 0; number < all.size(); ++number) {
        const std::string& type = all[number];
        CAPTURE(type);
        const Outcome made = folder.run("new " + type + " -o new/" + type + ".toml");
        REQUIRE_MESSAGE(made.exit_status == 0, made.errors);
        const std::string path = folder.files().path("new/" + type + ".toml");
        Scene scene;
        const Status read = read_scene_file(path, {}, scene);
        REQUIRE_MESSAGE(bool(read), read.message);
        CHECK(scene.output.files == Names{type + ".png", type + ".exr"});
        const Outcome planned = folder.run("plan new/" + type + ".toml");
        CHECK_MESSAGE(planned.exit_status == 0, planned.errors);
        CHECK(planned.errors == "");
        if (number % stride != 0) continue;
        const std::string files = exr && png ? "" : " -o new/a.pfm";
        const Outcome rendered = folder.run("render -q --set camera.resolution=[32,18] new/" +
                                            type + ".toml --strict" + files);
        CHECK_MESSAGE(rendered.exit_status == 0, rendered.errors);
        CHECK(rendered.errors == "");
    }
}

TEST_CASE("new: each key has a line that says what it is") {
    const ProgramFolder folder;
    for (const std::string& type : types(folder)) {
        const Outcome printed = folder.run("new " + type + " -o -");
        REQUIRE(printed.exit_status == 0);
        std::istringstream lines(printed.output);
        std::string before;
        int keys = 0;
        for (std::string line; std::getline(lines, line); before = line) {
            if (line.find(" = ") == std::string::npos || line[0] == '#') continue;
            CAPTURE(line);
            CHECK(before.compare(0, 2, "# ") == 0);
            CHECK(before.size() > 12);
            ++keys;
        }
        CHECK(keys >= 10);
        // As a file it is the same.
        REQUIRE(folder.run("new " + type + " -o " + type + ".toml").exit_status == 0);
        CHECK(folder.files().get(type + ".toml") == printed.output);
    }
    const std::string box = folder.run("new box -o -").output;
    CHECK(holds(box, "# vertical field of view; perspective only; deg; default 40\nfov_deg = "));
}

TEST_CASE("new: a file of a density is a scene around it") {
    const ProgramFolder folder;
    std::filesystem::create_directory(folder.files().path("in"));
    folder.files().put("in/a.pbrt",
                       "Volume \"volumegrid\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 2 "
                       "\"point p0\" [-50 -50 0] \"point p1\" [50 50 100] "
                       "\"float density\" [ 1 1 ]\n");
    REQUIRE(folder.run("new in/a.pbrt -o out/deep/b.toml").exit_status == 0);
    CHECK(holds(folder.files().get("out/deep/b.toml"), "density = \"../../in/a.pbrt\"\n"));
    const Outcome rendered = folder.run(
        "render -q --strict --set camera.resolution=[32,18] out/deep/b.toml -o out/b.pfm");
    CHECK_MESSAGE(rendered.exit_status == 0, rendered.errors);
    check_refused(folder, "new in/none.vdb -o c.toml", "in/none.vdb: ");
    check_refused(folder, "new s.raw -o c.toml", "s.raw: ");
}

TEST_CASE("new: nothing is written over, and what is wrong is a line") {
    const ProgramFolder folder;
    const std::string before = folder.files().get("s.toml");
    check_refused(folder, "new box -o s.toml",
                  "s.toml: is there, allowed: another name, or --force");
    CHECK(folder.files().get("s.toml") == before);
    check_refused(folder, "new cumulus -o a.toml",
                  "pileus new: no such type, \"cumulus\", allowed: cumulus-humilis, cumulus-med");
    check_refused(folder, "new box",
                  "pileus new: no output, allowed: -o FILE.toml, or -o - to print");
    check_refused(folder, "new -o a.toml", "pileus new: no type, allowed: ");
    check_refused(folder, "new box -o a.exr", "a.exr: extension: no scene, allowed: .toml");
    check_refused(folder, "new box -o - --force", "--force: nothing is written over");
    check_refused(folder, "new box -o ''", "");
    REQUIRE(folder.run("new box -o s.toml --force").exit_status == 0);
    CHECK(folder.files().get("s.toml") != before);
}
