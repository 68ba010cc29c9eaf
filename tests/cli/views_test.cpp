// SPDX-License-Identifier: Apache-2.0
// The program's views and followed photons: files, reports, faults.
// in: PILEUS_PROGRAM -> out: pass or fail.
// docs/program.md; docs/how-it-works.md
#include <nlohmann/json.hpp>

#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"

using namespace pileus;
using nlohmann::json;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

namespace {

const char* const kViews[] = {"density-slice", "gradient-slice", "gradient", "samples",     "tree",
                              "leaf-density",  "collectors",     "photons",  "illumination"};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("views: each writes its picture and says which steps ran") {
    const ProgramFolder folder;
    std::vector<std::string> hashes;
    for (const char* view : kViews) {
        CAPTURE(view);
        const std::string name = view;
        const Outcome outcome = folder.run(
            "render s.toml --set medium.0.resolution=[8,8,8] --quiet -o a.pfm a.ppm --report "
            "r.json "
            "--show " +
            name);
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        CHECK(outcome.errors == "");
        CHECK(folder.left() == Names{"a.pfm", "a.ppm", "r.json"});
        const json report = json::parse(folder.files().get("r.json"));
        const std::string hash = report["hash"];
        CHECK(hash == outcome.output.substr(0, 16));
        CHECK(report["digests"]["image"] == hash);
        for (const std::string& other : hashes) CHECK(other != hash);
        hashes.push_back(hash);
        // Only the last step needs photons that light collectors.
        const bool lit = name == "illumination";
        CHECK(report["photons"] == (lit ? 1000 : 0));
        CHECK(report["time"]["stages"].contains("photons") == lit);
        const bool sampled = name == "samples" || name == "tree" || name == "leaf-density" ||
                             name == "collectors" || lit;
        CHECK((report["samples"].get<int>() > 0) == sampled);
        CHECK((report["leaves"].get<int>() > 0) == (sampled && name != "samples"));
        CHECK(!report["time"]["stages"].contains("march"));
    }
}

TEST_CASE("views: an unknown one is refused with all names, before anything is written") {
    const ProgramFolder folder;
    const Outcome outcome = folder.run("render s.toml -o a.pfm --show leaves");
    CHECK(outcome.exit_status == 2);
    CHECK(line_count(outcome.errors) == 1);
    CHECK(holds(outcome.errors, "--show: no such view, \"leaves\", allowed: "));
    for (const char* view : kViews) CHECK(holds(outcome.errors, view));
    CHECK(folder.left() == Names{});
}

TEST_CASE("views: exposure is for light alone") {
    const ProgramFolder folder;
    CHECK(folder.run("render s.toml -o a.ppm --show tree --exposure 1").exit_status == 2);
    CHECK(folder.left() == Names{});
    CHECK(folder.run("render s.toml -o a.ppm --show illumination").exit_status == 0);
    const std::string plain = folder.files().get("a.ppm");
    CHECK(folder.run("render s.toml -o a.ppm --show illumination --exposure 2").exit_status == 0);
    CHECK(folder.files().get("a.ppm") != plain);
}

TEST_CASE("views: closure camera has cells for leaves, and no samples") {
    const ProgramFolder folder;
    const std::string camera = " --set collectors.closure=camera -o a.pfm --show ";
    for (const char* view : {"density-slice", "tree", "leaf-density", "collectors", "photons"}) {
        const Outcome outcome = folder.run("render s.toml" + camera + view);
        CHECK_MESSAGE(outcome.exit_status == 0, outcome.errors);
    }
    for (const char* view : {"gradient", "gradient-slice", "samples", "illumination"}) {
        const Outcome outcome = folder.run("render s.toml" + camera + view);
        CHECK(outcome.exit_status == 2);
        CHECK(holds(outcome.errors, "closure \"camera\" has no such step"));
    }
}

TEST_CASE("views: frames turn with the camera") {
    const ProgramFolder folder;
    folder.files().put("f.toml", test::small_scene() + std::string("[animation]\nframes = 2\n"
                                                                   "camera_orbit_deg = [0, 30]\n"));
    const Outcome both = folder.run("render f.toml -o a.pfm --show samples --quiet");
    REQUIRE_MESSAGE(both.exit_status == 0, both.errors);
    CHECK(folder.files().get("a.0000.pfm") != folder.files().get("a.0001.pfm"));
    const Outcome last = folder.run("render f.toml -o b.pfm --show samples --frames 1 --quiet");
    REQUIRE_MESSAGE(last.exit_status == 0, last.errors);
    CHECK(folder.files().get("a.0001.pfm") == folder.files().get("b.0001.pfm"));
}

TEST_CASE("follow: a photon's events, from its light to its end") {
    const ProgramFolder folder;
    const Outcome way = folder.run("follow s.toml --photon 3");
    REQUIRE_MESSAGE(way.exit_status == 0, way.errors);
    CHECK(holds(way.output, "light sun\n"));
    CHECK(holds(way.output, " start "));
    CHECK(line_count(way.output) >= 4);
    CHECK(folder.run("follow s.toml --photon 3 --isa scalar").output == way.output);
    CHECK(folder.run("follow s.toml --photon 4").output != way.output);
    CHECK(folder.run("follow s.toml --photon 3 --seed 8").output != way.output);
    // 1000 photons in four generations.
    CHECK(folder.run("follow s.toml --photon 249").exit_status == 0);
    const Outcome beyond = folder.run("follow s.toml --photon 250");
    CHECK(beyond.exit_status == 2);
    CHECK(holds(beyond.errors,
                "--photon: not in the first generation of the sun, 250, allowed: "
                "less than 250"));
    const Outcome dark = folder.run("follow s.toml --light 1");
    CHECK(dark.exit_status == 2);
    CHECK(holds(dark.errors, "--light: no such light, 1, allowed: less than 1"));
    CHECK(folder.run("follow s.toml --photon x").exit_status == 2);
    CHECK(folder.left() == Names{});
}
