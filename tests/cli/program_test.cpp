// SPDX-License-Identifier: Apache-2.0
// The command line: every kind of fault has its exit status and line, and leaves no file behind.
// in: PILEUS_PROGRAM -> out: pass or fail.
// docs/program.md
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "src/io/images/image_file.h"
#include "src/session/render.h"
#include "tests/cli/run_program.h"

using namespace pileus;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

// A sanitizer's own shadow memory does not fit under a limit on addresses.
#if defined(__SANITIZE_ADDRESS__)
#define PILEUS_TEST_ADDRESS_LIMIT 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PILEUS_TEST_ADDRESS_LIMIT 0
#endif
#endif
#ifndef PILEUS_TEST_ADDRESS_LIMIT
#define PILEUS_TEST_ADDRESS_LIMIT 1
#endif

namespace {

struct Fault {
    const char* arguments;
    int exit_status;
    const char* line;  ///< part of the line on the standard error
};

/// One line each, nothing on the standard output, no file.
void check_fault(const ProgramFolder& folder, const Fault& fault) {
    CAPTURE(fault.arguments);
    const Outcome outcome = folder.run(fault.arguments);
    CHECK(outcome.exit_status == fault.exit_status);
    CHECK_MESSAGE(holds(outcome.errors, fault.line), outcome.errors);
    CHECK(line_count(outcome.errors) == 1);
    CHECK(outcome.output == "");
    CHECK(folder.left().empty());
}

}  // namespace

TEST_CASE("program: wrong usage is one line and exit 2") {
    const ProgramFolder folder;
    const Fault faults[] = {
        {"", 2,
         "no subcommand, allowed: render, plan, view, follow, flux, compare, study, hash, info, "
         "methods, convert"},
        {"paint s.toml", 2,
         "unknown subcommand, \"paint\", allowed: render, plan, view, follow, flux, compare, "
         "study, hash, info, methods, convert"},
        {"--loud render s.toml", 2, "unknown option before the subcommand, \"--loud\""},
        {"compare a.exr b.exr", 2, "a.exr: cannot read: no such file"},
        {"convert a.exr b.png", 2, "b.png: extension: unknown, \".png\", allowed: .raw .vdb"},
        {"view s.toml --size 1x1", 2, "--size: \"1x1\", allowed: WIDTHxHEIGHT, 16 to 16384 each"},
        {"view none.toml --script none.txt", 2, "none.txt"},
        {"render s.toml -o a.pfm --loud", 2, "--loud, allowed: see pileus render --help"},
        {"render s.toml t.toml -o a.pfm", 2, "t.toml, allowed: see pileus render --help"},
        {"render -o a.pfm", 2, "SCENE.toml: missing"},
        {"plan", 2, "SCENE.toml: missing"},
        {"render s.toml -o", 2, "see pileus render --help"},
        {"hash", 2, "see pileus hash --help"},
    };
    for (const Fault& fault : faults) check_fault(folder, fault);
}

TEST_CASE("program: a wrong value names its option and what is allowed, exit 2") {
    const ProgramFolder folder;
    const Fault faults[] = {
        {"render s.toml -o a.pfm --threads 0", 2, "--threads: no such whole number, \"0\""},
        {"render s.toml -o a.pfm --threads -1", 2, "\"-1\", allowed: 1 to 1024"},
        {"render s.toml -o a.pfm --threads abc", 2, "\"abc\", allowed: 1 to 1024"},
        {"render s.toml -o a.pfm --threads 2x", 2, "\"2x\", allowed: 1 to 1024"},
        {"render s.toml -o a.pfm --isa mmx", 2, "--isa: no such instruction set here, \"mmx\""},
        {"render s.toml -o a.pfm --seed -1", 2, "--seed: no such whole number, \"-1\""},
        {"render s.toml -o a.pfm --seed 1.5", 2, "--seed: no such whole number, \"1.5\""},
        {"render s.toml -o a.pfm --exposure bright", 2, "allowed: -64 to 64, or auto"},
        {"render s.toml -o a.pfm --exposure nan", 2, "--exposure: no such number, \"nan\""},
        {"render s.toml -o a.pfm --frames 0-1", 2, "--frames: no such frames, \"0-1\""},
        {"render s.toml -o a.pfm --frames x", 2, "allowed: A-B within 0-0"},
        {"render s.toml -o a.pfm --budget photons=-5", 2, "--budget photons: no such whole number"},
        {"render s.toml -o a.pfm --budget photons=5.5", 2,
         "--budget photons: no such whole number"},
        {"render s.toml -o a.pfm --budget photons=1e19", 2,
         "--budget photons: no such whole number"},
        {"render s.toml -o a.pfm --budget photons=5__0", 2,
         "--budget photons: no such whole number"},
        {"render s.toml -o a.pfm --budget seconds=0", 2, "--budget seconds: no such number"},
        {"render s.toml -o a.pfm --budget seconds=inf", 2, "--budget seconds: no such number"},
        {"render s.toml -o a.pfm --budget error=1", 2,
         "--budget error: not for method collectors, allowed: photons=N, seconds=S"},
        {"render s.toml -o a.pfm --budget samples=9", 2,
         "--budget samples: not for method collectors"},
        {"render s.toml -o a.pfm --budget generations=0", 2,
         "--budget generations: no such whole number, \"0\", allowed: 1 to "},
        {"render s.toml -o a.pfm --budget generations=1 --set method.name=path", 2,
         "--budget generations: not for method path, allowed: samples=N, error=E, seconds=S"},
        {"render s.toml -o a.pfm --budget generations=1 --set method.name=raymarch", 2,
         "--budget generations: not for method raymarch, allowed: steps=N, seconds=S"},
        {"flux s.toml --budget generations=1", 2,
         "--budget generations: not for method flux, allowed: samples=N"},
        {"render s.toml -o a.pfm --budget paths=9", 2, "--budget: unknown kind, \"paths=9\""},
        {"render s.toml -o a.pfm --budget steps=9", 2,
         "--budget steps: not for method collectors, allowed: photons=N, seconds=S"},
        {"render s.toml -o a.pfm --set method.name=raymarch --budget steps=65537", 2,
         "--budget steps: "},
        {"render s.toml -o a.pfm --budget samples=0", 2, "--budget samples: "},
        {"render s.toml -o a.pfm --budget error=0", 2, "--budget error: "},
        {"render s.toml -o a.pfm --state x", 2, "--state: not for method collectors"},
        {"render s.toml -o a.pfm --state ''", 2, "--state: no name"},
        {"render s.toml -o a.pfm --state-every 3", 2, "--state-every: without --state"},
        {"render s.toml -o a.pfm --budget luck=1", 2, "--budget: unknown kind, \"luck=1\""},
        {"render s.toml -o a.pfm --show depth", 2, "--show: no such view, \"depth\""},
        {"render s.toml -o a.pfm --set camera.fov_deg=wide", 2, "camera.fov_deg"},
        {"render s.toml -o a.pfm --set camera.colour=1", 2, "camera.colour"},
    };
    for (const Fault& fault : faults) check_fault(folder, fault);
}

TEST_CASE("program: faults of scene and files, exit 2") {
    const ProgramFolder folder;
    check_fault(folder, {"render none.toml -o a.pfm", 2, "none.toml: no such file"});
    check_fault(folder, {"hash none.pfm", 2, "none.pfm: cannot read: no such file"});
    check_fault(folder, {"info none.pbrt", 2, "none.pbrt: cannot read: no such file"});
    check_fault(folder, {"info s.bmp", 2, "unknown, \".bmp\""});
    check_fault(folder, {"info x.raw", 2, "--size: missing"});
    check_fault(folder, {"info --phase", 2, "--phase: no file"});
    check_fault(folder, {"info --phase none.txt", 2, "none.txt: cannot read: no such file"});
    check_fault(folder, {"render s.toml -o a.bmp", 2, "a.bmp: extension: unknown, \".bmp\""});
    check_fault(folder, {"render s.toml -o a", 2, "a: extension: unknown, \"\""});
    check_fault(folder, {"render s.toml -o a.pfm -o a.pfm", 2, "a.pfm: output: named twice"});
    check_fault(folder, {"render s.toml", 2, "s.toml: output.files: no output"});

    folder.files().put("bad.toml", "sead = 7\n" + std::string(test::small_scene()));
    const Outcome bad = folder.run("render bad.toml -o a.pfm");
    CHECK(bad.exit_status == 2);
    CHECK_MESSAGE(holds(bad.errors, "bad.toml:1:1: sead: "), bad.errors);
    CHECK(folder.left() == std::vector<std::string>{"bad.toml"});
}

TEST_CASE("program: all faults of a command line come at once, one line each") {
    const ProgramFolder folder;
    const Outcome outcome =
        folder.run("render s.toml -o a.pfm --threads 0 --isa mmx --set camera.fov_deg=-3 --seed x");
    CHECK(outcome.exit_status == 2);
    CHECK(line_count(outcome.errors) == 4);
    for (const char* part : {"--threads", "--isa", "camera.fov_deg", "--seed"})
        CHECK_MESSAGE(holds(outcome.errors, part), outcome.errors);
}

TEST_CASE("program: what cannot be written is exit 4, before and after rendering") {
    const ProgramFolder folder;
    check_fault(folder, {"render s.toml -o s.toml/a.pfm", 4, "s.toml/a.pfm: cannot write"});
    check_fault(folder, {"render s.toml -o a.pfm --report /proc/none/r.json", 4,
                         "/proc/none/r.json: cannot write"});

    // The picture, 480 bytes and a head, fits under the limit on a file's size (2 blocks of 512 or
    // 1024 bytes, as the shell counts) and the report does not.
    const Outcome full =
        folder.run("render s.toml -o z/a.pfm --report r.json --set camera.resolution=[8,5]",
                   "trap '' XFSZ; ulimit -f 2 &&");
    CHECK(full.exit_status == 4);
    CHECK_MESSAGE(holds(full.errors, "r.json: cannot write"), full.errors);
    CHECK(line_count(full.errors) == 1);
    CHECK(folder.left().empty());
}

TEST_CASE("program: a failed rendering leaves an older picture as it was") {
    const ProgramFolder folder;
    folder.files().put("a.pfm", "older");
    const Outcome full =
        folder.run("render s.toml -o a.pfm --report r.json --set camera.resolution=[8,5]",
                   "trap '' XFSZ; ulimit -f 2 &&");
    CHECK(full.exit_status == 4);
    CHECK(folder.files().get("a.pfm") == "older");
    CHECK(folder.left() == std::vector<std::string>{"a.pfm"});
}

#if PILEUS_TEST_ADDRESS_LIMIT
TEST_CASE("program: too little memory is exit 3 and one line") {
    const ProgramFolder folder;
    // 2^28 pixels need gigabytes; the limit leaves the program itself ample room.
    const Outcome outcome = folder.run(
        "render s.toml --threads 1 -o a.pfm --set camera.resolution=[16384,16384] "
        "--limit pixels=268435456 --limit memory=1T",
        "ulimit -v 600000 &&");
    CHECK(outcome.exit_status == 3);
    CHECK_MESSAGE(holds(outcome.errors, "out of memory"), outcome.errors);
    CHECK(line_count(outcome.errors) == 1);
    CHECK(folder.left().empty());
}
#endif

TEST_CASE("program: a standard output that cannot take the result is exit 4") {
    const ProgramFolder folder;
    const Outcome info = folder.run("info >/dev/full 2>.err; exit $? #");
    CHECK(info.exit_status == 4);
    const Outcome render = folder.run("render s.toml -o a.pfm >/dev/full 2>.err; exit $? #");
    CHECK(render.exit_status == 4);
    CHECK_MESSAGE(holds(render.errors, "standard output: cannot write"), render.errors);
    CHECK(folder.left().empty());
}

TEST_CASE("program: version and help go to the standard output, exit 0") {
    const ProgramFolder folder;
    const Outcome version = folder.run("--version");
    CHECK(version.exit_status == 0);
    // Behind the version the commit, where the build knows it.
    const std::string known = std::string("pileus ") + kVersion;
    const std::string commit = version.output.substr(std::min(known.size(), version.output.size()));
    CHECK(version.output.compare(0, known.size(), known) == 0);
    CHECK_MESSAGE((commit == "\n" || (commit.substr(0, 2) == " (" && commit.size() > 5 &&
                                      commit.substr(commit.size() - 2) == ")\n")),
                  commit);
    CHECK(holds(folder.run("info").output, version.output.substr(7)));
    CHECK(folder.run("-h").output == folder.run("--help").output);
    CHECK(holds(folder.run("--help").output, "Usage: pileus"));
    CHECK(holds(folder.run("--help").output, "Example:\n  pileus render "));
    for (const char* name :
         {"render", "plan", "follow", "compare", "study", "hash", "info", "convert"}) {
        CAPTURE(name);
        const Outcome help = folder.run(name + std::string(" --help"));
        CHECK(help.exit_status == 0);
        CHECK(holds(help.output, "Usage: pileus"));
        CHECK(holds(help.output, std::string("Example:\n  pileus ") + name + " "));
        CHECK(help.errors == "");
    }
    // The help names the views that an unknown one is answered with.
    const std::string fault = folder.run("render s.toml --show none").errors;
    const std::string mark = "allowed: ";
    std::string views = fault.substr(fault.find(mark) + mark.size());
    views.pop_back();
    std::string help = folder.run("render --help").output;
    help.erase(
        std::remove_if(help.begin(), help.end(), [](char c) { return c == ' ' || c == '\n'; }),
        help.end());
    views.erase(std::remove(views.begin(), views.end(), ' '), views.end());
    CHECK_MESSAGE(holds(help, views), views);
}
