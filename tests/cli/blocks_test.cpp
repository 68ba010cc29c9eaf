// SPDX-License-Identifier: Apache-2.0
// Files of blocks from end to end, and what the program says of devices.
// in: a small scene and command lines -> out: pass or fail.
// docs/crosscheck.md
#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"

using namespace pileus;
using test::holds;
using test::Outcome;
using test::ProgramFolder;
using Names = std::vector<std::string>;

namespace {

/// A path tracer's picture has no bias, and its noise is known.
const std::string kRender =
    "render s.toml --quiet --set method.name=path --set path.samples_per_pixel=8 "
    "--set camera.fov_deg=16 ";

void write_blocks(const ProgramFolder& folder, const std::string& options) {
    const Outcome outcome = folder.run(kRender + options);
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    CHECK(holds(outcome.output, "blocks"));
}

}  // namespace

TEST_CASE("blocks: other seeds pass, half as much light again is found") {
    ProgramFolder folder;
    write_blocks(folder, "--blocks a.txt --block-side 4");
    write_blocks(folder, "--blocks b.txt --block-side 4 --seed 500 --block-passes 24");
    write_blocks(folder, "--blocks c.txt --block-side 4 --seed 900 --set sun.irradiance=1.5");
    CHECK(folder.left() == Names{"a.txt", "b.txt", "c.txt"});

    const Outcome same = folder.run("compare --welch a.txt b.txt --json");
    REQUIRE_MESSAGE(same.exit_status == 0, same.errors);
    const auto json = nlohmann::json::parse(same.output);
    CHECK(json["blocks"] == 12);
    CHECK(json["passes"] == std::vector<double>{16, 24});
    CHECK(json["differ"] == false);
    CHECK(json["channels"]["G"]["detectable_bias"].get<double>() < 0.25);

    const Outcome bright = folder.run("compare --welch c.txt a.txt");
    CHECK(bright.exit_status == 1);
    CHECK(holds(bright.output, "the means differ at significance 6.8e-06"));
    CHECK(holds(bright.errors, "c.txt: means: differ from a.txt"));
}

TEST_CASE("blocks: the file holds the picture's means, whatever the instruction set") {
    ProgramFolder folder;
    write_blocks(folder, "--blocks a.txt --block-passes 3");
    write_blocks(folder, "--blocks b.txt --block-passes 3 --threads 1 --isa scalar");
    CHECK(folder.files().get("a.txt") == folder.files().get("b.txt"));
    CHECK(holds(folder.files().get("a.txt"), "pileus-blocks 1\npicture 16 9 side 8\n"));
}

TEST_CASE("blocks: wrong use and wrong files end with a line and leave nothing") {
    ProgramFolder folder;
    folder.files().put("short.txt", "pileus-blocks 1\npicture 8 8 side 8\n4 2 1 2 1 2 1\n");
    folder.files().put("nan.txt", "pileus-blocks 1\npicture 8 8 side 8\n4 nan 1 2 1 2 1\n");
    const struct {
        const char *command, *words;
    } cases[] = {
        {"render s.toml --block-passes 3", "--block-passes, --block-side: without --blocks"},
        {"render s.toml --blocks x.txt --block-passes 1", "--block-passes"},
        {"render s.toml --blocks x.txt --block-side 0", "--block-side"},
        {"render s.toml --blocks x.txt -o p.pfm", "--blocks: together with -o or --report"},
        {"render s.toml --blocks x.txt --show tree", "--blocks: together with --show or --state"},
        {"compare --welch short.txt short.txt", "short.txt:4: passes: the file ends before it"},
        {"compare --welch nan.txt short.txt", "nan.txt:3: sum: \"nan\""},
        {"compare --welch no.txt short.txt", "no.txt"},
        {"compare --welch short.txt short.txt --significance 2", "--significance"},
        {"compare short.txt short.txt --significance 1e-3", "--significance: without --welch"},
    };
    for (const auto& c : cases) {
        const Outcome outcome = folder.run(c.command);
        CAPTURE(c.command);
        CHECK(outcome.exit_status == 2);
        CHECK_MESSAGE(holds(outcome.errors, c.words), outcome.errors);
    }
    CHECK(folder.left() == Names{"nan.txt", "short.txt"});
}

TEST_CASE("device: info tells of one, and --isa cuda renders or ends with a line") {
    ProgramFolder folder;
    const Outcome info = folder.run("info");
    CHECK(info.exit_status == 0);
    CHECK(holds(info.output, "\ndevice         cuda"));
    const Outcome outcome = folder.run("render s.toml -o a.pfm --isa cuda");
    if (holds(info.output, "device         cuda (")) {
        CHECK_MESSAGE(outcome.exit_status == 0, outcome.errors);
        return;
    }
    CHECK(outcome.exit_status == 2);
    CHECK(holds(outcome.errors, "--isa: \"cuda\": no"));
    CHECK(holds(outcome.errors, "allowed: scalar"));
    CHECK(folder.left().empty());
}
