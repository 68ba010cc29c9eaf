// SPDX-License-Identifier: Apache-2.0
// Skies of many clouds from scene files: stills, films, made again, and who refuses them.
// in: PILEUS_PROGRAM, small scenes -> out: pass or fail.
// docs/clouds.md, "In a scene file"
#include <nlohmann/json.hpp>

#include "tests/cli/remake_checks.h"

using namespace pileus;
using test::check_refused;
using test::holds;
using test::Outcome;
using test::ProgramFolder;

namespace {

/// A sky of `n` clouds of two kinds that share a scene.
std::string sky_text(int n = 24) {
    return "[camera]\n"
           "position_m = [0, 0, 200]\n"
           "target_m = [0, 100, 202]\n"
           "resolution = [48, 27]\n"
           "[sky]\n"
           "radiance = [0.1, 0.2, 0.4]\n"
           "[sun]\n"
           "azimuth_deg = 250\n"
           "elevation_deg = 40\n"
           "[ground]\n"
           "[[clouds.kind]]\n"
           "name = \"box\"\n"
           "scene = \"s.toml\"\n"
           "set = [\"method.name=raymarch\", \"raymarch.steps=12\"]\n"
           "[[clouds.kind]]\n"
           "name = \"ball\"\n"
           "scene = \"s.toml\"\n"
           "set = [\"method.name=raymarch\", \"raymarch.steps=12\", "
           "\"medium.0.density=uniform:sphere\"]\n"
           "[[clouds.place]]\n"
           "kind = \"ball\"\n"
           "offset_m = [0, 600, 200]\n"
           "scale = 2.0\n"
           "[[clouds.scatter]]\n"
           "count = " +
           std::to_string(n) +
           "\n"
           "seed = 1\n"
           "near_m = 800\n"
           "far_m = 4000\n"
           "base_m = [250, 350]\n"
           "scale = [0.7, 1.6]\n"
           "yaw_steps = 2\n"
           "[clouds.detail]\n"
           "near_px = 16\n";
}

struct SkyFolder : ProgramFolder {
    explicit SkyFolder(const std::string& text = sky_text()) { files().put("sky.toml", text); }

    std::string hash(const std::string& options, const std::string& name = "a.ppm") const {
        const Outcome outcome = run("render sky.toml -q -o a.ppm " + options);
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        const std::size_t at = outcome.output.find(" " + name);
        REQUIRE(at != std::string::npos);
        return outcome.output.substr(at - 16, 16);
    }
};

constexpr const char* kFilm =
    "--set animation.frames=4 --set 'animation.keys=[{frame=0,camera_position_m=[0,0,200]},"
    "{frame=3,camera_position_m=[30,90,210]}]' --set animation.sun_elevation_deg=[40,38] ";

}  // namespace

TEST_CASE("many clouds: a still, the same on any threads and instruction sets, and its report") {
    const SkyFolder folder;
    const std::string first = folder.hash("--threads 1 --report r.json");
    for (const char* options : {"--threads 3", "--isa scalar --threads 2"})
        CHECK(folder.hash(options) == first);
    CHECK(folder.run("render sky.toml -q -o a.pfm --expect-hash " + first).exit_status == 0);
    CHECK(folder.run("render sky.toml -q -o a.pfm --expect-hash 0000000000000000").exit_status ==
          1);
    const auto report = nlohmann::json::parse(folder.files().get("r.json"));
    CHECK(report["hash"] == first);
    const auto& clouds = report["clouds"];
    CHECK(clouds["clouds"] == 25);
    CHECK(clouds["kinds"].size() == 2);
    CHECK(clouds["kinds"][0]["name"] == "box");
    CHECK(clouds["kinds"][1]["method"] == "raymarch");
    CHECK(clouds["kinds"][0]["clouds"].get<int>() + clouds["kinds"][1]["clouds"].get<int>() == 25);
    CHECK(clouds["visible"].get<int>() > 2);
    CHECK(clouds["marched"].get<int>() > 0);
    CHECK(clouds["shown"].get<int>() > 0);
    CHECK(clouds["visible"] == clouds["marched"].get<int>() + clouds["shown"].get<int>());
    CHECK(report["time"]["stages"].contains("clouds marched"));
    CHECK(report["time"]["stages"].contains("clouds lit"));
    // Other clouds, and fewer; the first ones stay.
    CHECK(folder.hash("--set clouds.scatter.0.seed=2") != first);
    CHECK(folder.hash("--set clouds.scatter.0.count=3") != first);
    CHECK(folder.hash("--set clouds.detail.off=true") != first);
    const std::string info = folder.run("info sky.toml").output;
    CHECK(holds(info, "clouds         25\n"));
    CHECK(holds(info, "kind of clouds ball, s.toml\n"));
}

TEST_CASE("many clouds: layers are those of the picture") {
    if (test::skips_pictures()) return;
    const SkyFolder folder;
    const std::string plain = folder.hash("");
    const Outcome outcome =
        folder.run("render sky.toml -q -o b.exr --set output.layers=[depth,cloud]");
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    Image image;
    REQUIRE(read_image(folder.files().path("b.exr"), image));
    CHECK(image.pixel_hash == outcome.output.substr(0, 16));
    const Channel *a = image.find("A"), *z = image.find("Z"), *c = image.find("cloud.G");
    REQUIRE((a != nullptr && z != nullptr && c != nullptr));
    std::size_t clouds = 0;
    for (std::size_t i = 0; i < a->pixels.size(); ++i) {
        if (a->pixels[i] == 0) CHECK(c->pixels[i] == 0);
        if (!(a->pixels[i] > 0.6f)) continue;
        ++clouds;
        CHECK((z->pixels[i] > 300 && z->pixels[i] < 9000));
    }
    CHECK(clouds > 20);
}

TEST_CASE("many clouds: a film goes from frame to frame, and its frames are made again") {
    if (test::skips_pictures()) return;
    const SkyFolder folder;
    const std::string film = std::string("render sky.toml -q -o a.exr ") + kFilm;
    const Outcome first = folder.run(film + "--threads 1"),
                  again = folder.run(film + "--threads 2");
    REQUIRE_MESSAGE(first.exit_status == 0, first.errors);
    CHECK(first.output == again.output);
    CHECK(test::line_count(first.output) == 4);
    // Each frame by its picture alone, whatever the sky's file is by then.
    folder.files().put("sky.toml", "no scene");
    for (const char* name : {"a.0000.exr", "a.0003.exr"}) {
        const Outcome same = folder.run(std::string("render ") + name + " -q");
        CHECK_MESSAGE(same.exit_status == 0, same.errors);
        CHECK(holds(first.output, same.output));
    }
    // The scenes of the kinds are files that must be there, and the same.
    const std::string s = folder.files().get("s.toml");
    folder.files().put("s.toml", s + "[ground]\nalbedo = 0.9\n");
    CHECK(folder.run("render a.0000.exr -q").exit_status == 0);
    std::filesystem::remove(folder.files().path("s.toml"));
    check_refused(folder, "render a.0000.exr -q", "a.0000.exr: needs ./s.toml: no such file");
}

TEST_CASE("many clouds: what they cannot be refuses with a line") {
    const SkyFolder folder;
    const auto refused = [&](const std::string& arguments, const std::string& said) {
        check_refused(folder, arguments, said);
    };
    const std::string render = "render sky.toml -o a.pfm ";
    for (const char* option : {"--budget seconds=1", "--quality draft", "--show density-slice",
                               "--verify 10", "--state st"})
        refused(render + option, ": not for a scene with [clouds]");
    refused("render sky.toml --blocks a.blocks", "--blocks: not for a scene with [clouds]");
    folder.files().put("keys", "");
    for (const char* command : {"plan sky.toml", "flux sky.toml", "follow sky.toml",
                                "pack sky.toml -o a.packed", "view sky.toml --script keys"})
        refused(command, "sky.toml:11:1: clouds.kind: many clouds are drawn by pileus render");
    folder.files().put("study.toml",
                       "[reference]\nbudget = \"samples=4\"\n[[scene]]\nname = \"a\"\n"
                       "file = \"sky.toml\"\n[[method]]\nname = \"raymarch\"\n"
                       "budgets = [\"steps=9\"]\n");
    const Outcome study = folder.run("study study.toml --list");
    CHECK(study.exit_status == 2);
    CHECK_MESSAGE(holds(study.errors, "clouds.kind: a study compares methods over media"),
                  study.errors);

    refused(render + "--set clouds.kind.0.scene=no.toml",
            "clouds.kind.0.scene: no.toml: no such file");
    refused(render + "--set clouds.kind.0.scene=sky.toml --set 'clouds.kind.0.set=[]'",
            "clouds.kind.0.scene: sky.toml: [clouds]");
    refused(render + "--set 'clouds.kind.0.set=[\"medium.0.albedo=2\"]'",
            "clouds.kind.0.scene: --set medium.0.albedo=2");
    refused(render + "--set 'clouds.kind.0.set=[\"medium=[]\"]'", "clouds.kind.0.scene: kind: ");
    folder.files().put("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    refused(render + "--set 'clouds.kind.1.set=[\"solid.0.file=m.obj\"]'",
            "clouds.kind.1.scene: kind: a scene with [[solid]]");
    folder.files().put("v0.raw", std::string(64, 'x'));
    const std::string sequence =
        "--set 'clouds.kind.0.set=[\"medium.0.density={file=\\\"v#.raw\\\",type=\\\"uint8\\\","
        "size=[4,4,4]}\"]' ";
    refused("render sky.toml -o a.#.pfm " + sequence + kFilm,
            "clouds.kind.0.scene: s.toml: a sequence of files in a film of clouds");
    refused(render + "--set clouds.scatter.0.scale=[60,60]", "clouds.scatter.0.count: room for ");
    refused(render + "--set clouds.scatter.0.count=1000",
            "clouds.scatter: too many clouds in all, 1001");
    refused(render + "--report s.toml", "s.toml: ");
}
