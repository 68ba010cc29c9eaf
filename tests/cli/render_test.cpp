// SPDX-License-Identifier: Apache-2.0
// What the program writes: pictures, hashes, reports, frames; and what it says about files.
// in: PILEUS_PROGRAM -> out: pass or fail.
// docs/program.md; docs/report.md
#include "src/session/render.h"

#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "src/io/images/image_file.h"
#include "src/plan/report_json.h"
#include "tests/cli/run_program.h"

using namespace pileus;
using nlohmann::json;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

namespace {

using Names = std::vector<std::string>;

std::string first_word(const std::string& text) { return text.substr(0, text.find(' ')); }

const char* const kReportKeys[] = {
    "/version",
    "/scene",
    "/method",
    "/isa",
    "/threads",
    "/team",
    "/seed",
    "/hash",
    "/plan/needed",
    "/plan/left_out",
    "/plan/bytes",
    "/plan/total_bytes",
    "/memory/peak_bytes",
    "/time/total_s",
    "/time/cpu_s",
    "/time/stages",
    "/interrupted",
    "/photons",
    "/paths",
    "/samples_per_pixel",
    "/shadow_rays",
    "/scatterings",
    "/tentative",
    "/scatterings_per_second",
    "/photons_per_second",
    "/paths_per_second",
    "/ahead",
    "/ring",
    "/frame_work/scale",
    "/frame_work/photons",
    "/warnings",
    "/energy",
    "/error/mean_relative",
    "/error/rmse_estimate",
    "/counters/clamped_negative",
    "/counters/nan",
    "/counters/saturated",
    "/counters/majorant_violations",
    "/digests",
};
const char* const kEnergyKeys[] = {
    "light",  "emitted", "top",        "bottom",        "sides",          "absorbed",
    "ground", "sky",     "terminated", "direct_bottom", "standard_error", "balance_quanta"};

Image grey_image() {
    Image image;
    image.width = 3;
    image.height = 2;
    const char* const names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        image.channels.emplace_back();
        image.channels.back().name = names[c];
        REQUIRE(image.channels.back().pixels.resize(6, "plane"));
        for (std::size_t i = 0; i < 6; ++i)
            image.channels.back().pixels[i] = 0.1f * float(c + 1) + float(i);
    }
    return image;
}

}  // namespace

TEST_CASE("render: the picture's hash is the same on stdout, in the report and from the file") {
    const ProgramFolder folder;
    const bool exr = bool(can_write_image("a.exr"));
    const std::string files = exr ? "-o x/a.exr x/b.pfm" : "-o x/b.pfm";
    const Outcome outcome = folder.run("render s.toml " + files + " --report x/r.json");
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    CHECK(outcome.errors == "");
    CHECK(folder.left() ==
          (exr ? Names{"x", "x/a.exr", "x/b.pfm", "x/r.json"} : Names{"x", "x/b.pfm", "x/r.json"}));
    const std::string hash = first_word(outcome.output);
    CHECK(hash.size() == 16);
    // A .pfm alone has no alpha, and so another one.
    if (exr) CHECK(json::parse(folder.files().get("x/r.json"))["hash"] == hash);
    if (exr) CHECK(folder.run("hash x/a.exr").output == hash + "\n");
}

TEST_CASE("render: the report has every key, and fractions of energy that add up") {
    const ProgramFolder folder;
    REQUIRE(folder.run("render s.toml --report r.json --threads 1").exit_status == 0);
    const json report = json::parse(folder.files().get("r.json"));
    for (const char* key : kReportKeys)
        CHECK_MESSAGE(report.contains(json::json_pointer(key)), key);
    CHECK(report["version"] == kVersion);
    CHECK(report["scene"] == "s.toml");
    CHECK(report["seed"] == 7);
    CHECK(report["threads"] == 1);
    CHECK(report["photons"] == 1000);
    REQUIRE(report["energy"].size() == 1);
    const json& row = report["energy"][0];
    for (const char* key : kEnergyKeys) CHECK_MESSAGE(row.contains(key), key);
    CHECK(row["balance_quanta"] == 0);
    double sum = 0;
    for (const char* fate : {"top", "bottom", "sides", "absorbed", "ground", "sky", "terminated"})
        sum += row[fate].get<double>();
    CHECK(sum == doctest::Approx(1).epsilon(1e-12));  // seven roundings of 2^-53 each
    std::uint64_t peak = 0, all = 0;
    for (const auto& stage : report["plan"]["stages"])
        peak = std::max(peak, stage.get<std::uint64_t>());
    for (const auto& item : report["plan"]["bytes"]) all += item.get<std::uint64_t>();
    CHECK(report["plan"]["total_bytes"] == peak);
    CHECK(peak < all);  // not all live at once
    CHECK(report["plan"]["exact"] == true);
    for (const auto& stage : report["time"]["stages"]) {
        CHECK(stage["wall_s"].get<double>() >= 0);
        CHECK(stage["cpu_s"].get<double>() >= 0);
    }
    CHECK(report["time"]["stages"].contains("photons"));
}

TEST_CASE("render: options change what they name and nothing else") {
    const ProgramFolder folder;
    const auto hash = [&](const std::string& options) {
        const Outcome outcome = folder.run("render s.toml -o a.pfm " + options);
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        return first_word(outcome.output);
    };
    const std::string plain = hash("");
    CHECK(hash("--threads 1 --isa scalar --quiet") == plain);
    CHECK(hash("--threads 3 --budget photons=1000 --budget seconds=3600") == plain);
    // Numbers as scenes write them.
    CHECK(hash("--budget photons=1e3") == plain);
    CHECK(hash("--budget photons=1_000 --budget seconds=3_600") == plain);
    CHECK(hash("--seed 8") != plain);
    CHECK(hash("--seed 8") == hash("--set seed=8"));
    CHECK(hash("--budget photons=2000") == hash("--set collectors.photons=2000"));
    CHECK(hash("--budget photons=2000") != plain);
    const std::string march = "--set method.name=raymarch ";
    CHECK(hash(march + "--budget steps=3") == hash(march + "--set raymarch.steps=3"));
    CHECK(hash(march + "--budget steps=3") != hash(march));
}

TEST_CASE("render: --quality is a word for settings, and what is typed counts more") {
    const ProgramFolder folder;
    const auto hash = [&](const std::string& options) {
        const Outcome o = folder.run("render s.toml --quiet -o a.pfm " + options);
        REQUIRE_MESSAGE(o.exit_status == 0, o.errors);
        return first_word(o.output);
    };
    const std::string path = "--set method.name=path ", filter = "--set filter.kind=regression ",
                      four = "--set path.samples_per_pixel=4 ";
    const std::string draft = hash(path + "--quality draft");
    CHECK(draft == hash(path + filter + four));
    CHECK(draft != hash(path + four));
    CHECK(hash(path + "--quality draft --budget samples=2") ==
          hash(path + filter + "--budget samples=2"));
    CHECK(hash(path + "--quality draft --set filter.kind=none") == hash(path + four));
    CHECK(hash(path + four + "--quality final") == hash(path + four));
    CHECK(hash("--quality draft") == hash("--set collectors.node_filter=guided"));
    CHECK(hash("--quality final") == hash(""));
    CHECK(hash("--set method.name=raymarch --quality draft") ==
          hash("--set method.name=raymarch --set raymarch.steps=96 --set raymarch.scale=2"));
    const Outcome o = folder.run("render s.toml -o b.pfm --quality best");
    CHECK(o.exit_status == 2);
    CHECK(holds(o.errors, "--quality: unknown, \"best\", allowed: draft, final"));
    CHECK(line_count(o.errors) == 1);
    CHECK(folder.files().get("b.pfm").empty());
}

TEST_CASE("render: -o replaces the scene's files, and may stand before the scene") {
    const ProgramFolder folder;
    const std::string output = "[output]\nfiles = [\"own.pfm\"]\nreport = \"own.json\"\n";
    folder.files().put("o.toml", test::small_scene() + output);
    REQUIRE(folder.run("render o.toml").exit_status == 0);
    CHECK(folder.left() == Names{"o.toml", "own.json", "own.pfm"});
    REQUIRE(folder.run("render -o a.pfm b.ppm o.toml --report r.json").exit_status == 0);
    CHECK(folder.left() == Names{"a.pfm", "b.ppm", "o.toml", "own.json", "own.pfm", "r.json"});
    // The scene's report is that of the scene's pictures: -o leaves it alone, too.
    folder.files().put("own.json", "older");
    const Outcome other = folder.run("render o.toml -o a.pfm --quiet");
    REQUIRE(other.exit_status == 0);
    CHECK(line_count(other.output) == 1);
    CHECK(folder.files().get("own.json") == "older");
}

TEST_CASE("render: a report named - goes to the standard output, alone") {
    const ProgramFolder folder;
    const Outcome outcome = folder.run("render s.toml -o a.pfm --report -");
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    CHECK(folder.left() == Names{"a.pfm"});
    const json report = json::parse(outcome.output);
    // A .ppm keeps no float: its line has the picture's own hash.
    const Outcome shown = folder.run("render s.toml -o a.ppm");
    CHECK(report["hash"] == first_word(shown.output));
    std::filesystem::remove(folder.files().path("a.ppm"));
    // Elsewhere the name is refused, and ./- is a file of that name.
    for (const char* option : {"-o b.pfm --state - --set method.name=path", "--blocks -"}) {
        const Outcome refused = folder.run(std::string("render s.toml ") + option);
        CHECK(refused.exit_status == 2);
        CHECK_MESSAGE(holds(refused.errors, "-: output: only a report"), refused.errors);
    }
    CHECK(folder.left() == Names{"a.pfm"});
    REQUIRE(folder.run("render s.toml --report ./-").exit_status == 0);
    CHECK(folder.left() == Names{"-", "a.pfm"});
}

TEST_CASE("render: frames are numbered, also one by one, and repeat the whole's pictures") {
    const ProgramFolder folder;
    folder.files().put("f.toml",
                       test::small_scene() + std::string("[animation]\nframes = 3\n"
                                                         "camera_orbit_deg = [0, 90]\n"
                                                         "sun_elevation_deg = [40, 9]\n"));
    const Outcome all = folder.run("render f.toml -o a.pfm --report r.json --quiet");
    REQUIRE_MESSAGE(all.exit_status == 0, all.errors);
    CHECK(line_count(all.output) == 6);
    CHECK(folder.left() == Names{"a.0000.pfm", "a.0001.pfm", "a.0002.pfm", "f.toml", "r.0000.json",
                                 "r.0001.json", "r.0002.json"});
    const Outcome last = folder.run("render f.toml -o b.pfm --frames 2-2 --quiet");
    REQUIRE_MESSAGE(last.exit_status == 0, last.errors);
    CHECK(folder.files().get("b.0002.pfm") == folder.files().get("a.0002.pfm"));
    CHECK(folder.files().get("a.0000.pfm") != folder.files().get("a.0002.pfm"));
}

TEST_CASE("render: quiet says only which files it wrote") {
    const ProgramFolder folder;
    const Outcome loud = folder.run("render s.toml -o a.pfm");
    const Outcome quiet = folder.run("render s.toml -o a.pfm --quiet");
    CHECK(holds(loud.output, "total "));
    CHECK(quiet.output == loud.output.substr(0, loud.output.find('\n') + 1));
    CHECK(quiet.errors == "");
}

TEST_CASE("hash: EXR and PFM of one picture without A agree") {
    const ProgramFolder folder;
    const Image image = grey_image();
    REQUIRE(write_image(image, folder.files().path("p.pfm"), {}));
    const std::string line = pixel_hash(image) + "\n";
    CHECK(folder.run("hash p.pfm").output == line);
    if (!can_write_image("p.exr")) {
        MESSAGE("skipped: EXR is left out of this build");
        return;
    }
    REQUIRE(write_image(image, folder.files().path("p.exr"), {}));
    CHECK(folder.run("hash p.exr").output == line);
}

TEST_CASE("info: the program, a scene, a picture and a grid") {
    const ProgramFolder folder;
    const Outcome program = folder.run("info");
    CHECK(program.exit_status == 0);
    for (const char* part : {"version ", "compiler ", "scalar (1 lane", "chosen)", "threads "})
        CHECK_MESSAGE(holds(program.output, part), program.output);

    CHECK(holds(folder.run("info s.toml").output, "16 x 9, perspective"));
    folder.files().put("sky.toml",
                       "[camera]\nposition_m = [0, 0, 0]\ntarget_m = [1, 0, 0]\n[sun]\n"
                       "[[medium]]\ndensity = \"procedural:sky\"\n"
                       "bounds_m = [[0, 0, 500], [4000, 4000, 2000]]\n"
                       "[medium.sky]\ntype = \"stratus\"\n");
    CHECK(holds(folder.run("info sky.toml").output, " procedural:sky, type stratus, extinction"));
    REQUIRE(write_image(grey_image(), folder.files().path("p.pfm"), {}));
    const Outcome picture = folder.run("info p.pfm");
    CHECK(holds(picture.output, "3 x 2"));
    CHECK_MESSAGE(holds(picture.output, "0.1 to 5.1, mean 2.6"), picture.output);

    folder.files().put("g.raw", std::string("\x00\x80\x00\xff", 4));
    const Outcome grid = folder.run("info g.raw --size 2 2 1 --type uint8");
    CHECK_MESSAGE(grid.exit_status == 0, grid.errors);
    CHECK_MESSAGE(holds(grid.output, "2 of 4 cells"), grid.output);
    const Outcome wrong = folder.run("info g.raw --size 2 2 2 --type uint8");
    CHECK(wrong.exit_status == 2);
}

TEST_CASE("info: grids that know their place and unit") {
    const ProgramFolder folder;
    folder.files().put("c.txt", "1,2,2\n.1,.05\n.4,.44\ni,j,k,lwc,reff\n0,0,1,1,15\n");
    const Outcome les = folder.run("info c.txt");
    CHECK_MESSAGE(les.exit_status == 0, les.errors);
    for (const char* part :
         {"LES text, columns with names", "1 x 2 x 2", "100 x 50 x 40 m",
          "0 0 380 to 100 100 460 m", "extinction in 1/m", "0 to 0.1, mean 0.025, 25 % not zero",
          "3 of 4 cells", "along z: mean 2, largest 4"})
        CHECK_MESSAGE(holds(les.output, part), part, "\n", les.output);

    folder.files().put("p.pbrt",
                       "Volume \"volumegrid\" \"integer nx\" 1 \"integer ny\" 1 "
                       "\"integer nz\" 1 \"float density\" 3");
    const Outcome pbrt = folder.run("info p.pbrt");
    for (const char* part : {"pbrt text volume", "not in the file", "relative density"})
        CHECK_MESSAGE(holds(pbrt.output, part), part, "\n", pbrt.output);
    CHECK_FALSE(holds(pbrt.output, "optical depth"));

    // Damaged files and texts of another kind: one line, nothing on the standard output.
    folder.files().put("d.vol", "VOL\x03");
    folder.files().put("notes.txt", "Dear diary,\n");
    for (const char* name : {"d.vol", "notes.txt"}) {
        const Outcome damaged = folder.run(std::string("info ") + name);
        CHECK(damaged.exit_status == 2);
        CHECK(damaged.output.empty());
        CHECK_MESSAGE(std::count(damaged.errors.begin(), damaged.errors.end(), '\n') == 1,
                      damaged.errors);
    }
}

TEST_CASE("plan: expected seconds of stills and films, and of budgets that are an amount of work") {
    const ProgramFolder folder;
    CHECK(holds(folder.run("plan s.toml --time").output, "time on this machine\n  in all"));
    CHECK_FALSE(holds(folder.run("plan s.toml").output, "time on this machine"));
    for (const char* film : {"camera_orbit_deg=[0,9]", "keys=[{frame=0,camera_fov_deg=9}]"})
        for (const char* method : {"collectors", "raymarch", "path"}) {
            CAPTURE(method);
            const Outcome plan = folder.run(
                std::string(
                    "plan s.toml --time --json --set animation.frames=100 --set animation.") +
                film + " --set output.layers='[\"radiance\"]' --set method.name=" + method);
            REQUIRE_MESSAGE(plan.exit_status == 0, plan.errors);
            const json time = json::parse(plan.output)["foretold_time"];
            CHECK(time["first_frame_s"] > 0);
            CHECK(time["next_frame_s"] > 0);
            const double all =
                time["first_frame_s"].get<double>() + 99 * time["next_frame_s"].get<double>();
            CHECK(time["total_s"].get<double>() == doctest::Approx(all));
        }
    const Outcome budget = folder.run("plan s.toml --time --budget seconds=1");
    CHECK(budget.exit_status == 2);
    CHECK(holds(budget.errors, "--time: a budget of seconds"));
    CHECK(folder.left().empty());
}

TEST_CASE("plan: lines for people, JSON with the report's keys, and no file") {
    const ProgramFolder folder;
    const Outcome lines = folder.run("plan s.toml");
    CHECK(lines.exit_status == 0);
    for (const char* part : {"needed\n", "left out\n", "memory (at most)", "total at once",
                             "bounds", "bias", "work", "limits"})
        CHECK_MESSAGE(holds(lines.output, part), lines.output);
    const Outcome plan = folder.run("plan s.toml --json --set method.name=collectors");
    REQUIRE(plan.exit_status == 0);
    const json parsed = json::parse(plan.output);
    for (const char* key : {"needed", "left_out", "exact", "bytes", "total_bytes", "arrays",
                            "stages", "bounds", "bias", "work", "limits"})
        CHECK_MESSAGE(parsed["plan"].contains(key), key);
    CHECK(parsed["plan"]["exact"] == false);
    for (const auto& bound : parsed["plan"]["bounds"])
        CHECK(bound["worst"].get<double>() < bound["allowed"].get<double>());
    CHECK(parsed["plan"]["total_bytes"].get<std::uint64_t>() > 0);
    CHECK(folder.left().empty());
}

TEST_CASE("report: what is no number becomes null, what is no text does no harm") {
    Report report;
    report.clocks.total_s = std::numeric_limits<double>::infinity();
    report.errors.known = true;
    report.errors.mean_relative = std::numeric_limits<double>::quiet_NaN();
    report.errors.rmse_estimate = 0.25;
    report.scene = "a\"\xff\n";
    report.clocks.stages = {{"photons", 1, 2}, {"photons", 3, 4}};
    report.plan.memory.add("grid", Stage::kTree, Stage::kTree, 5);
    report.plan.memory.add("grid", Stage::kTree, Stage::kWrite, 6);
    report.counters = {{"nan", 1}, {"nan", 2}};
    report.photons.traced = 10;
    report.clocks.tracing_cpu_s = 2.5;
    const json parsed = json::parse(report_json(report));
    CHECK(parsed["time"]["total_s"].is_null());
    CHECK(parsed["error"]["mean_relative"].is_null());
    CHECK(parsed["error"]["rmse_estimate"] == 0.25);
    CHECK(parsed["scene"] == "a\"\xef\xbf\xbd\n");
    CHECK(parsed["time"]["stages"]["photons"]["wall_s"] == 4.0);
    CHECK(parsed["time"]["stages"]["photons"]["cpu_s"] == 6.0);
    CHECK(parsed["plan"]["bytes"]["grid"] == 11);
    CHECK(parsed["counters"]["nan"] == 2);
    CHECK(parsed["photons_per_second"] == 4.0);

    report.errors.known = false;
    report.clocks.tracing_cpu_s = 0;
    const json none = json::parse(report_json(report));
    CHECK(none["error"]["rmse_estimate"].is_null());
    CHECK(none["photons_per_second"].is_null());
}
