// SPDX-License-Identifier: Apache-2.0
// pileus compare: exit statuses, lines, JSON, files left behind.
// in: small pictures and command lines -> out: pass or fail.
// docs/compare.md
#include <nlohmann/json.hpp>

#include "lab/compare/metrics.h"
#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"
#include "tests/io/test_image.h"

using namespace pileus;
using nlohmann::json;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;
using Names = std::vector<std::string>;

namespace {

/// R G B = `light` and a gradient, 12 x 9, as .pfm: every build can read and write it.
void put(const ProgramFolder& folder, const std::string& name, double light) {
    Image image = test::make_image(12, 9);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < 108; ++i)
            image.channels[c].pixels[i] = float(light + double(i) * 0.01);
    REQUIRE(write_image(image, folder.files().path(name), {}));
}

ProgramFolder* make_folder(ProgramFolder& folder) {
    put(folder, "a.pfm", 1.125);
    put(folder, "b.pfm", 1.0);
    put(folder, "c.pfm", 1.25);
    return &folder;
}

}  // namespace

TEST_CASE("compare: figures as JSON, the same as lines") {
    ProgramFolder folder;
    make_folder(folder);
    const Outcome outcome = folder.run("compare a.pfm b.pfm --json");
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    const json figures = json::parse(outcome.output);
    CHECK(figures["a"]["file"] == "a.pfm");
    CHECK(figures["reference"]["file"] == "b.pfm");
    CHECK(figures["pixels"] == 108);
    CHECK(figures["cloud_pixels"] == 108);
    CHECK(figures["alpha"] == false);
    CHECK(figures["rmse"].get<double>() == doctest::Approx(0.125).epsilon(1e-6));
    CHECK(figures["bias"].get<double>() == doctest::Approx(0.125).epsilon(1e-6));
    CHECK(figures["relmse"] == figures["relmse_raw"]);
    CHECK(figures["relmse_reference_noise"].is_null());
    CHECK(figures["bias_z"].is_null());
    CHECK(figures["flip"]["exposures"] == 2);
    CHECK(figures["flip"]["mean"].get<double>() > 0);
    const Outcome lines = folder.run("compare a.pfm b.pfm --no-flip");
    CHECK(holds(lines.output, "RMSE           0.125\n"));
    CHECK(holds(lines.output, "the reference has no alpha"));
    CHECK_FALSE(holds(lines.output, "FLIP"));
    CHECK(lines.errors == "");
    CHECK(folder.left() == Names{"a.pfm", "b.pfm", "c.pfm"});
}

TEST_CASE("compare: two halves are the reference") {
    ProgramFolder folder;
    make_folder(folder);
    const Outcome outcome = folder.run("compare a.pfm b.pfm --half c.pfm --no-flip --json");
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    const json figures = json::parse(outcome.output);
    // a is the mean of b and c: no raw error, and a product (a - b)(a - c) below zero.
    CHECK(figures["rmse"].get<double>() < 1e-6);
    CHECK(figures["relmse"].get<double>() < -0.003);
    CHECK(figures["halves"] == true);
    CHECK(figures["z"].is_null());
}

TEST_CASE("compare: halves give the figures of the library, over a smooth reference") {
    ProgramFolder folder;
    Image pictures[3];
    const char* const names[3] = {"a.pfm", "b.pfm", "c.pfm"};
    for (std::size_t n = 0; n < 3; ++n) {
        pictures[n] = test::make_image(12, 9);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < 108; ++i)
                pictures[n].channels[c].pixels[i] =
                    1 + 0.5f * float((i * (7 + 4 * n) + 5 * c) % 13) / 13;
        REQUIRE(write_image(pictures[n], folder.files().path(names[n]), {}));
        REQUIRE(read_image(folder.files().path(names[n]), pictures[n]));
    }
    Metrics metrics;
    REQUIRE(compare_with_halves(pictures[0], pictures[1], pictures[2], {}, metrics));
    const Outcome outcome = folder.run("compare a.pfm b.pfm --half c.pfm --no-flip --json");
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    CHECK(json::parse(outcome.output)["relmse"] == metrics.relmse);
}

TEST_CASE("compare: a picture and itself, error layers and all") {
    ProgramFolder folder;
    if (!can_write_image("a.exr")) {
        MESSAGE("skipped: EXR is left out of this build");
        return;
    }
    REQUIRE(folder.run("render s.toml -o a.exr --set 'output.layers=[\"error\"]'").exit_status ==
            0);
    const Outcome json_text = folder.run("compare a.exr a.exr --json --max-relmse 0");
    REQUIRE_MESSAGE(json_text.exit_status == 0, json_text.errors);
    const json figures = json::parse(json_text.output);
    CHECK(figures["identical"] == true);
    CHECK(figures["relmse_reference_noise"].get<double>() > 0);
    CHECK(figures["relmse"] == 0.0);
    CHECK(holds(folder.run("compare a.exr a.exr").output, "relMSE         0  (the counted pixels"));
}

TEST_CASE("compare: radiance and what a display shows of it are told apart") {
    ProgramFolder folder;
    if (!can_write_image("a.exr") || !can_write_image("a.png")) {
        MESSAGE("skipped: EXR or PNG is left out of this build");
        return;
    }
    REQUIRE(folder.run("render s.toml -o a.exr a.png").exit_status == 0);
    REQUIRE(folder.run("render s.toml -o b.png --exposure auto").exit_status == 0);
    for (const char* files : {"a.exr a.png", "a.png a.exr", "a.png b.png --half a.exr"}) {
        const Outcome mixed = folder.run(std::string("compare --difference d.pfm ") + files);
        CHECK(mixed.exit_status == 2);
        CHECK_MESSAGE(holds(mixed.errors, ".png: values: light of a display, while a.exr holds"),
                      mixed.errors);
        CHECK(line_count(mixed.errors) == 1);
        CHECK(mixed.output == "");
    }
    CHECK(folder.left() == Names{"a.exr", "a.png", "b.png"});
    // Shown alike, they are the same; at another exposure they are not.
    for (const char* files :
         {"a.exr a.png --exposure 0", "a.png a.exr --exposure 0", "a.exr b.png --exposure auto"}) {
        const Outcome same = folder.run(std::string("compare --json ") + files);
        REQUIRE_MESSAGE(same.exit_status == 0, same.errors);
        CHECK(json::parse(same.output)["identical"] == true);
        CHECK(json::parse(same.output)["flip"]["exposures"] == 1);
    }
    const Outcome brighter = folder.run("compare a.exr a.png --exposure 1 --json");
    CHECK(json::parse(brighter.output)["bias"].get<double>() > 0);
    CHECK(json::parse(brighter.output)["a"]["read_as"] == "shown at exposure 1");
    CHECK(folder.run("compare a.exr a.png --exposure x").exit_status == 2);
}

TEST_CASE("compare: limits decide the exit status, one line each") {
    ProgramFolder folder;
    make_folder(folder);
    const std::string files = "compare a.pfm b.pfm ";
    CHECK(folder
              .run(files + "--max-relmse 0.02 --max-rmse 0.13 --max-abs 0.13 --max-bias 0.1 "
                           "--max-flip 0.5")
              .exit_status == 0);
    const char* const low[5] = {"--max-relmse 0.001", "--max-rmse 0.12", "--max-abs 0.12",
                                "--max-bias 0.01", "--max-flip 0.001"};
    for (const char* option : low) {
        const Outcome outcome = folder.run(files + option + " -- ");
        INFO(option << outcome.errors);
        CHECK(outcome.exit_status == 1);
        CHECK(holds(outcome.errors, "a.pfm: "));
        CHECK(holds(outcome.errors, ", allowed: at most 0."));
        CHECK(holds(outcome.output, "relMSE"));  // the figures are still printed
    }
    const Outcome two = folder.run(files + "--max-rmse 0 --max-abs 0");
    CHECK(std::count(two.errors.begin(), two.errors.end(), '\n') == 2);
    CHECK(folder.run("compare b.pfm b.pfm --max-relmse 0 --max-flip 0").exit_status == 0);
}

TEST_CASE("compare: a pixel of low alpha is no part of means, and of --max-abs") {
    ProgramFolder folder;
    if (!can_write_image("a.exr")) {
        MESSAGE("skipped: EXR is left out of this build");
        return;
    }
    Image image = test::make_image(12, 9);
    for (Channel& channel : image.channels)
        for (float& v : channel.pixels.span()) v = channel.name == "A" ? 0.5f : 0.25f;
    for (Channel& channel : image.channels)
        if (channel.name == "A") channel.pixels[5] = 0;
    REQUIRE(write_image(image, folder.files().path("r.exr"), {}));
    for (Channel& channel : image.channels)
        if (channel.name == "G") channel.pixels[5] = 0.75f;
    REQUIRE(write_image(image, folder.files().path("a.exr"), {}));
    const Outcome told = folder.run("compare a.exr r.exr --no-flip --max-rmse 0");
    CHECK_MESSAGE(told.exit_status == 0, told.errors);
    CHECK(holds(told.output, "not counted    largest 0.5 at pixel 5, 0, where alpha is at most"));
    const Outcome counted = folder.run("compare a.exr r.exr --no-flip --max-abs 0.4");
    CHECK(counted.exit_status == 1);
    CHECK(counted.errors ==
          "a.exr: largest difference: above --max-abs at pixel 5, 0, 0.5, where alpha is too low "
          "to count, allowed: at most 0.4\n");
    CHECK(folder.run("compare a.exr r.exr --no-flip --max-abs 0.5").exit_status == 0);
    CHECK(folder.run("compare a.exr r.exr --no-flip --all-pixels --max-abs 0.4").exit_status == 1);
}

TEST_CASE("compare: a pixel that is not finite fails every limit") {
    ProgramFolder folder;
    make_folder(folder);
    Image image = test::make_image(12, 9);
    REQUIRE(read_image(folder.files().path("b.pfm"), image));
    image.channels[1].pixels[7] = std::numeric_limits<float>::quiet_NaN();
    REQUIRE(write_image(image, folder.files().path("n.pfm"), {}));
    CHECK(folder.run("compare n.pfm b.pfm").exit_status == 0);
    const Outcome outcome = folder.run("compare n.pfm b.pfm --max-relmse 1");
    CHECK(outcome.exit_status == 1);
    CHECK(outcome.errors == "n.pfm: pixels: not finite, 1, allowed: none in what is compared\n");
}

TEST_CASE("compare: pictures are written together, in values and in colours") {
    ProgramFolder folder;
    make_folder(folder);
    REQUIRE(folder.run("compare a.pfm b.pfm --difference d.pfm --flip x/f.ppm").exit_status == 0);
    CHECK(folder.left() == Names{"a.pfm", "b.pfm", "c.pfm", "d.pfm", "x", "x/f.ppm"});
    Image difference;
    REQUIRE(read_image(folder.files().path("d.pfm"), difference));
    for (float v : difference.find("G")->pixels.span())
        CHECK(double(v) == doctest::Approx(0.125).epsilon(1e-5));
    CHECK(folder.files().get("x/f.ppm").substr(0, 10) == "P6\n12 9\n25");
    // Without error layers there is no z map, and then no other file either.
    const Outcome none = folder.run("compare a.pfm b.pfm --z-map z.pfm --difference e.pfm");
    CHECK(none.exit_status == 2);
    CHECK(holds(none.errors, "z map: error layers: missing"));
    CHECK(folder.left().size() == 6);
}

TEST_CASE("compare: faults of input and use end with 2 and a line") {
    ProgramFolder folder;
    make_folder(folder);
    Image image = test::make_image(9, 12);
    REQUIRE(write_image(image, folder.files().path("t.pfm"), {}));
    const char* const rows[][2] = {
        {"a.pfm none.pfm", "none.pfm: cannot read: no such file"},
        {"a.pfm t.pfm", "a.pfm: sizes: differ, 12 x 9, allowed: 9 x 12"},
        {"a.pfm b.pfm --half t.pfm", "t.pfm: sizes: differ"},
        {"a.pfm b.pfm --layer cloud", "a.pfm: layer: not there, \"cloud\""},
        {"a.pfm b.pfm --max-relmse x", "--max-relmse: no such number, \"x\""},
        {"a.pfm b.pfm --max-relmse -1", "--max-relmse: no such number"},
        {"a.pfm b.pfm --flip-tone film", "--flip-tone: no such curve, film"},
        {"a.pfm b.pfm --pixels-per-degree 0", "--pixels-per-degree: no such number"},
        {"a.pfm b.pfm --difference d.txt", "d.txt: extension: unknown"},
        {"a.pfm b.pfm --difference b.pfm", "b.pfm: output: is a picture to compare"},
        {"a.pfm b.pfm --difference d.pfm --flip d.pfm", "d.pfm: output: named twice"},
        {"a.pfm b.pfm --no-flip --flip f.pfm", "--no-flip: not together with --flip"},
        {"a.pfm", "see pileus compare --help"},
        {"a.pfm s.toml", "s.toml: extension: unknown"}};
    for (const auto& row : rows) {
        const Outcome outcome = folder.run(std::string("compare ") + row[0]);
        INFO(row[0] << ": " << outcome.errors);
        CHECK(outcome.exit_status == 2);
        CHECK(holds(outcome.errors, row[1]));
        CHECK(outcome.output == "");
    }
    CHECK(folder.left() == Names{"a.pfm", "b.pfm", "c.pfm", "t.pfm"});
}

TEST_CASE("compare and hash: pictures of the program itself, and of 8 bits") {
    ProgramFolder folder;
    const bool exr = bool(can_write_image("a.exr")), png = bool(can_write_image("a.png"));
    if (!exr || !png) {
        MESSAGE("skipped: EXR or PNG is left out of this build");
        return;
    }
    const std::string layers =
        " --set 'output.layers=[\"error\", \"cloud\"]' --set 'sky.radiance=[0.1, 0.1, 0.1]' ";
    REQUIRE(folder.run("render s.toml --seed 1 -o a.exr a.png" + layers).exit_status == 0);
    REQUIRE(folder.run("render s.toml --seed 2 -o b.exr b.png" + layers).exit_status == 0);
    const Outcome light = folder.run("compare a.exr b.exr --json --z-map z.exr --difference d.png");
    REQUIRE_MESSAGE(light.exit_status == 0, light.errors);
    const json figures = json::parse(light.output);
    CHECK(figures["alpha"] == true);
    CHECK(figures["cloud_pixels"] < figures["pixels"]);
    CHECK(figures["relmse_reference_noise"].get<double>() > 0);
    CHECK(figures["z"]["values"].get<double>() > 0);
    CHECK(figures["relmse"].get<double>() < figures["relmse_raw"].get<double>());
    // Another layer has no error layers of its own.
    const Outcome cloud = folder.run("compare a.exr b.exr --layer cloud --json --no-flip");
    CHECK(json::parse(cloud.output)["z"].is_null());
    CHECK(json::parse(cloud.output)["a"]["read_as"] == "layer cloud");
    // Pictures of 8 bits are seen once, as a display shows them.
    const Outcome shown = folder.run("compare a.png b.png --json");
    REQUIRE_MESSAGE(shown.exit_status == 0, shown.errors);
    CHECK(json::parse(shown.output)["flip"]["exposures"] == 1);
    CHECK(folder.run("hash a.png").output.size() == 17);
    CHECK(folder.run("hash a.exr --layer cloud").output != folder.run("hash a.exr").output);
}
