// SPDX-License-Identifier: Apache-2.0
// No command writes over a file that it reads, nor two outputs into one file.
// in: PILEUS_PROGRAM, files under several names -> out: pass or fail.
// docs/program.md, "What is never overwritten"
#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"
#include "tests/cli/run_program.h"
#include "tests/io/test_image.h"
#include "tools/study/output_check.h"
#include "tools/study/scene_files.h"

using namespace pileus;
using test::holds;
using test::Outcome;
using test::ProgramFolder;
namespace fs = std::filesystem;

namespace {

const char* const kGrid =
    "Volume \"volumegrid\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 2 "
    "\"point p0\" [-50 -50 0] \"point p1\" [50 50 100] \"float density\" [ 1 1 ]\n";
const char* const kMesh =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// A scene that reads a file of every kind: all.toml.
void put_all(const ProgramFolder& folder) {
    Image image = test::make_image(16, 9);
    for (std::size_t c = 0; c < 3; ++c)
        for (float& value : image.channels[c].pixels.span()) value = 200;
    REQUIRE(write_image(image, folder.files().path("sky.pfm"), {}));
    REQUIRE(write_image(image, folder.files().path("depth.pfm"), {}));
    folder.files().put("cloud.pbrt", kGrid);
    folder.files().put("phase.txt", "0 1\n180 1\n");
    folder.files().put("mesh.ply", kMesh);
    folder.files().put("all.toml",
                       "[camera]\nposition_m = [0, -300, 50]\ntarget_m = [0, 0, 50]\n"
                       "resolution = [16, 9]\ndepth = \"depth.pfm\"\n[sky]\nmap = \"sky.pfm\"\n"
                       "[[solid]]\nfile = \"mesh.ply\"\n[[medium]]\ndensity = \"cloud.pbrt\"\n"
                       "extinction_per_m = 0.05\n"
                       "phase = { type = \"table\", file = \"phase.txt\" }\n");
}

/// Everything in the folder but what `run` keeps: name, bytes.
std::vector<std::string> contents(const ProgramFolder& folder) {
    std::vector<std::string> all;
    for (const std::string& name : folder.left()) {
        all.push_back(name);
        if (fs::is_regular_file(folder.files().path(name)))
            all.back() += "\n" + folder.files().get(name);
    }
    all.push_back(folder.files().get("s.toml"));
    return all;
}

/// One line, exit 2, every file as it was.
void check_kept(const ProgramFolder& folder, const std::string& arguments,
                const std::string& part) {
    CAPTURE(arguments);
    const std::vector<std::string> before = contents(folder);
    const Outcome outcome = folder.run(arguments);
    CHECK(outcome.exit_status == 2);
    CHECK_MESSAGE(holds(outcome.errors, part), outcome.errors);
    CHECK(test::line_count(outcome.errors) == 1);
    CHECK(outcome.output == "");
    CHECK(contents(folder) == before);
}

}  // namespace

TEST_CASE("overwrite: render writes over nothing that its scene reads") {
    const ProgramFolder folder;
    put_all(folder);
    const std::string render = "render all.toml ";
    const std::string read = " output: is a file that the scene reads, allowed: another file\n";
    for (const char* name : {"cloud.pbrt", "phase.txt", "mesh.ply", "sky.pfm", "depth.pfm"})
        check_kept(folder, render + "-o a.pfm --report " + name, name + (":" + read));
    for (const char* name : {"sky.pfm", "depth.pfm"})
        check_kept(folder, render + "-o " + name, name + (":" + read));
    check_kept(folder, render + "--set method.name=path -o a.pfm --state cloud.pbrt",
               "cloud.pbrt:" + read);
    check_kept(folder, render + "--blocks phase.txt", "phase.txt:" + read);
    check_kept(folder, render + "-o a.pfm --report all.toml",
               "all.toml: output: is the scene itself");
    check_kept(folder, render + "-o a.pfm --set output.files=[] --report ./mesh.ply",
               "./mesh.ply: output: is a file that the scene reads, mesh.ply, allowed");
    // Outputs of the scene itself, and names that an option brings.
    check_kept(folder, render + "--set output.files=[sky.pfm]", "sky.pfm:" + read);
    check_kept(folder, "render s.toml --set sky.map=sky.pfm -o sky.pfm", "sky.pfm:" + read);
}

TEST_CASE("overwrite: links of either kind are the files that they lead to") {
    const ProgramFolder folder;
    put_all(folder);
    const test::TempFolder& files = folder.files();
    fs::create_symlink("sky.pfm", files.path("link.pfm"));
    fs::create_hard_link(files.path("sky.pfm"), files.path("hard.pfm"));
    fs::create_directory(files.path("folder"));
    fs::create_directory_symlink("folder", files.path("other"));
    fs::create_symlink("new.pfm", files.path("folder/ahead.pfm"));
    for (const char* name : {"link.pfm", "hard.pfm"})
        check_kept(folder, std::string("render all.toml -o ") + name,
                   name + std::string(": output: is a file that the scene reads, sky.pfm, "));
    // Two outputs are one file, whether it is there or not.
    const std::string same = "output: is the same file as ";
    check_kept(folder, "render s.toml -o a.pfm --report ./a.pfm", "./a.pfm: " + same + "a.pfm");
    check_kept(folder, "render s.toml -o folder/a.pfm other/a.pfm",
               "other/a.pfm: " + same + "folder/a.pfm");
    check_kept(folder, "render s.toml -o folder/new.pfm other/ahead.pfm",
               "other/ahead.pfm: " + same + "folder/new.pfm");
    check_kept(folder, "render s.toml -o no/a.pfm no/x/../a.pfm", same + "no/a.pfm");
    check_kept(folder, "render s.toml -o hard.pfm link.pfm", "link.pfm: " + same + "hard.pfm");
}

TEST_CASE("overwrite: every frame of an animation is looked at") {
    const ProgramFolder folder;
    put_all(folder);
    fs::rename(folder.files().path("sky.pfm"), folder.files().path("sky.0002.pfm"));
    const std::string render =
        "render all.toml --set sky.map=sky.0002.pfm --set animation.frames=4 -o sky.pfm ";
    check_kept(folder, render, "sky.0002.pfm: output: is a file that the scene reads");
    check_kept(folder, render + "--frames 1-3", "sky.0002.pfm: output: is a file");
    CHECK(folder.run(render + "--frames 3-3 --budget photons=10").exit_status == 0);
}

TEST_CASE("overwrite: convert, compare") {
    const ProgramFolder folder;
    put_all(folder);
    REQUIRE(folder.run("convert cloud.pbrt c.vdb").exit_status == 0);
    fs::create_symlink("c.vdb", folder.files().path("d.vdb"));
    check_kept(folder, "convert c.vdb c.vdb", "c.vdb: output: is the grid that is read");
    check_kept(folder, "convert c.vdb d.vdb", "d.vdb: output: is the grid that is read, c.vdb");
    check_kept(folder, "compare sky.pfm depth.pfm --difference sky.pfm",
               "sky.pfm: output: is a picture to compare");
    check_kept(folder, "compare sky.pfm depth.pfm --difference x.pfm --flip ./x.pfm",
               "./x.pfm: output: is the same file as x.pfm");
}

TEST_CASE("overwrite: a study") {
    const ProgramFolder folder;
    put_all(folder);
    const std::string study =
        "seeds = 1\n[reference]\nbudget = \"photons=2000\"\n[[scene]]\nname = \"box\"\n"
        "file = \"all.toml\"\n[[method]]\nname = \"m\"\nbudgets = [\"photons=500\"]\n";
    folder.files().put("study.toml", study);
    if (!can_write_image("x.exr")) {
        MESSAGE("skipped: studies need EXR, which is left out of this build");
        return;
    }
    fs::create_directories(folder.files().path("out/plots"));
    fs::create_hard_link(folder.files().path("mesh.ply"), folder.files().path("out/study.md"));
    check_kept(folder, "study study.toml -o out",
               "out/study.md: output: is a file that a scene reads, mesh.ply");
    fs::remove(folder.files().path("out/study.md"));
    fs::create_symlink("../../study.toml", folder.files().path("out/plots/box.svg"));
    check_kept(folder, "study study.toml -o out", "out/plots/box.svg: output: is the study itself");
}

TEST_CASE("overwrite: the list of a scene's files, those of a glTF included") {
    const test::TempFolder folder;
    folder.put("m.gltf",
               "{\"x\": {\"buffers\": [{\"uri\": \"no.bin\"}]}, \"buffers\": [{\"uri\": \"m.bin\", "
               "\"byteLength\": 3}, {\"uri\": \"data:,abc\"}, {\"byteLength\": 1}, 7]}");
    folder.put("bad.gltf", "{\"buffers\": [{\"uri\": ");
    Scene scene;
    scene.directory = folder.path("");
    scene.directory.pop_back();
    for (const char* name : {"m.gltf", "bad.gltf", "none.gltf"}) {
        scene.solids.emplace_back();
        scene.solids.back().file = name;
    }
    scene.view_files.depth = "/d.exr";
    const std::vector<std::string> expected{folder.path("m.gltf"), folder.path("m.bin"),
                                            folder.path("bad.gltf"), folder.path("none.gltf"),
                                            "/d.exr"};
    CHECK(scene_files(scene) == expected);
}

TEST_CASE("overwrite: devices and pipes clash with nothing") {
    OutputCheck check;
    check.reads("/dev/null", "a file");
    CHECK(check.writes("/dev/null"));
    CHECK(check.writes("/dev/null"));
    CHECK(check.writes("/no/such/folder/x"));
    CHECK_FALSE(check.writes("/no/such/folder/./x"));
}
