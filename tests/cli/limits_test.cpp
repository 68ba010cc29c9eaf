// SPDX-License-Identifier: Apache-2.0
// Limits: on by default, raised and lowered by a switch, checked before anything is allocated.
// in: scenes over each limit -> out: exit 3, one line, no file; memory within the plan.
// docs/program.md, "Limits"; docs/report.md, "Memory".
#include "src/base/limits.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"
#include "tests/support/sanitized.h"

using namespace pileus;
using nlohmann::json;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

TEST_CASE("limits: every one refuses with one line, names its switch and leaves no file") {
    struct Case {
        const char *options, *line;
    };
    const Case cases[] = {
        {"--limit text=100", "s.toml: limits.text: needs "},
        {"--limit media=0", "s.toml: limits.media: needs 1, allowed: at most 0 (--limit media="},
        {"--limit side=3 --set medium.0.resolution=[4,1,1]",
         "limits.side: needs 4 cells, allowed: at most 3 cells (--limit side=...)"},
        {"--limit voxels=63 --set medium.0.resolution=[4,4,4]",
         "limits.voxels: needs 64 cells, allowed: at most 63 cells (--limit voxels=...)"},
        {"--limit samples=499", "limits.samples: needs 500, allowed: at most 499"},
        {"--limit photons=999", "limits.photons: needs 1000, allowed: at most 999"},
        {"--limit generations=3", "limits.generations: needs 4, allowed: at most 3"},
        {"--limit pixels=143", "limits.pixels: needs 144, allowed: at most 143"},
        {"--limit frames=1 --set animation.frames=2", "limits.frames: needs 2, allowed: at most 1"},
        {"--limit memory=1k", "limits.memory: needs "},
        {"--limit scatterings=2", "limits.scatterings: needs 3, allowed: at most 2"},
        {"--limit work=100", "limits.work: needs "},
        {"--limit leaves=2 --set medium.0.resolution=[16,16,16]", "s.toml: limits.leaves: needs 3"},
        {"--set medium.0.extinction_per_m=1e12", "limits.scatterings: needs "},
        {"--set medium.0.resolution=[4096,4096,4096]",
         "limits.voxels: needs 68719476736 cells, allowed: at most 2147483648 cells (no switch"},
        {"--set medium.0.resolution=[1290,1290,1290]", "limits.memory: needs "},
    };
    for (const Case& c : cases) {
        const ProgramFolder folder;
        const Outcome outcome =
            folder.run(std::string("render s.toml -o a.pfm --threads 1 ") + c.options);
        CHECK_MESSAGE(outcome.exit_status == 3, c.options, outcome.errors);
        CHECK_MESSAGE(holds(outcome.errors, c.line), outcome.errors);
        CHECK_MESSAGE(line_count(outcome.errors) == 1, outcome.errors);
        CHECK(folder.left().empty());
    }
}

TEST_CASE("limits: what is asked for exactly passes, and a raised limit lets more through") {
    const ProgramFolder folder;
    CHECK(folder.run("plan s.toml --limit pixels=144 --limit photons=1k --limit samples=500")
              .exit_status == 0);
    const char* const thick = "plan s.toml --set medium.0.extinction_per_m=1e12";
    CHECK(folder.run(thick).exit_status == 3);
    CHECK(folder.run(std::string(thick) + " --limit scatterings=10k").exit_status == 0);
}

TEST_CASE("limits: wrong switches are exit 2 and say what is allowed") {
    struct Case {
        const char *option, *line;
    };
    const Case cases[] = {
        {"speed=1", "--limit: no such limit, \"speed\", allowed: text, media, file"},
        {"pixels", "--limit pixels: no number in range, \"\", allowed: 0 to 268435456"},
        {"pixels=-1", "no number in range, \"-1\""},
        {"pixels=1.5", "no number in range"},
        {"pixels=1Q", "no number in range"},
        {"pixels=1G", "no number in range"},
        {"memory=99999999T", "no number in range"},
    };
    const ProgramFolder folder;
    for (const Case& c : cases) {
        const Outcome outcome = folder.run(std::string("plan s.toml --limit ") + c.option);
        CHECK_MESSAGE(outcome.exit_status == 2, c.option);
        CHECK_MESSAGE(holds(outcome.errors, c.line), outcome.errors);
    }
    Limits limits;
    REQUIRE(set_limit("memory=3Gi", limits));
    CHECK(limits[LimitId::kMemory] == 3ull << 30);
    REQUIRE(set_limit("photons=7M", limits));
    CHECK(limits[LimitId::kPhotons] == 7'000'000);
}

TEST_CASE("limits: help and the manual list every one with its default") {
    const ProgramFolder folder;
    const std::string help = folder.run("plan --help").output;
    std::ifstream page("docs/program.md");
    const std::string manual(std::istreambuf_iterator<char>(page), {});
    for (std::size_t i = 0; i < kLimitCount; ++i) {
        const LimitRow& row = limit_row(LimitId(i));
        const std::string start = std::string("| `") + row.name + "` | " +
                                  std::to_string(row.fallback) + " | " + std::to_string(row.most) +
                                  " | " + row.what;
        CHECK_MESSAGE(holds(help, std::string("  ") + row.name + " "), help);
        CHECK_MESSAGE(holds(manual, start), start);
    }
}

namespace {

/// A file of even noise, which no tree divides well and no compression makes smaller.
std::string noise(std::size_t count) {
    std::string bytes(count, '\0');
    std::uint32_t state = 1;
    for (char& byte : bytes) {
        state = state * 1664525u + 1013904223u;
        byte = char(state >> 24);
    }
    return bytes;
}

}  // namespace

TEST_CASE("memory: the process stays within the plan's bound, and the bound near the process") {
    // Program, libraries and the stacks of two threads; measured 7 to 10 MiB (docs/report.md).
    constexpr double kProgram = 16 * 1048576.0;
    struct Case {
        const char* options;
        double most_over_peak;  // how loose the bound may be
    };
    const Case cases[] = {
        {"--set medium.0.resolution=[1,1,1]", 3},
        {"--set medium.0.density=uniform:sphere --set medium.0.resolution=[32,32,32]", 3},
        {"--set medium.0.density=procedural:cumulus --set medium.0.resolution=[160,160,110]", 3},
        {"--set medium.0.density=procedural:cumulus --set medium.0.resolution=[128,128,128] "
         "--set collectors.samples=20000 --set camera.resolution=[640,360] "
         "--set 'output.layers=[\"error\",\"depth\"]'",
         3},
        {"--set 'medium.0.density={file=\"n.raw\",type=\"uint8\",size=[96,96,96]}' "
         "--set collectors.samples=20000",
         3},
    };
    ProgramFolder folder;
    folder.files().put("n.raw", noise(96 * 96 * 96));
    for (const Case& c : cases) {
        const std::string scene = std::string("s.toml --threads 2 ") + c.options;
        const Outcome plan = folder.run("plan " + scene + " --json");
        REQUIRE_MESSAGE(plan.exit_status == 0, plan.errors);
        const Outcome render = folder.run("render " + scene + " -o a.exr --report r.json");
        REQUIRE_MESSAGE(render.exit_status == 0, render.errors);
        const json report = json::parse(folder.files().get("r.json"));
        const double bound = json::parse(plan.output)["plan"]["total_bytes"];
        const double exact = report["plan"]["total_bytes"];
        const double peak = report["memory"]["peak_bytes"];
        INFO(c.options, " bound ", bound / 1048576, " exact ", exact / 1048576, " peak ",
             peak / 1048576, " MiB");
        CHECK(exact <= bound);
        // The sanitizers' own memory is no part of any plan.
        if (!test::kSanitized) {
            CHECK(peak <= 1.05 * bound + kProgram);
            CHECK(peak <= 1.05 * exact + kProgram);
            CHECK(bound <= c.most_over_peak * peak);
        }
        std::printf("memory: bound %7.1f exact %7.1f peak %7.1f MiB  %s\n", bound / 1048576,
                    exact / 1048576, peak / 1048576, c.options);
    }
}
