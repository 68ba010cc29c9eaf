// SPDX-License-Identifier: Apache-2.0
// render --expect-hash: whether pictures are as they should be.
// in: PILEUS_PROGRAM, hashes sound and broken -> out: pass or fail.
// docs/program.md, "render"
#include "tests/cli/run_program.h"

using namespace pileus;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

namespace {

const char* const kOther = "0123456789abcdef";

std::string upper(std::string text) {
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
    return text;
}

/// Hashes that a run printed, one for each line.
std::vector<std::string> hashes_of(const Outcome& outcome) {
    std::vector<std::string> hashes;
    for (std::size_t at = 0; at < outcome.output.size(); at = outcome.output.find('\n', at) + 1)
        hashes.push_back(outcome.output.substr(at, 16));
    return hashes;
}

}  // namespace

TEST_CASE("expect-hash: the same picture ends with 0, another with 1 and a line") {
    const ProgramFolder folder;
    for (const char* more : {"", "--seed 9", "--budget photons=300", "--set medium.0.albedo=0.9",
                             "--set method.name=path --budget samples=2", "--show density-slice"}) {
        CAPTURE(more);
        const std::string run = std::string("render s.toml -q -o a.pfm ") + more;
        const std::string hash = hashes_of(folder.run(run)).at(0);
        const Outcome same = folder.run(run + " --expect-hash " + hash);
        CHECK(same.exit_status == 0);
        CHECK(same.errors == "");
        CHECK(folder.run(run + " --expect-hash " + upper(hash)).exit_status == 0);
        std::filesystem::remove(folder.files().path("a.pfm"));
        const Outcome other = folder.run(run + " --expect-hash " + kOther);
        CHECK(other.exit_status == 1);
        CHECK(other.errors ==
              "s.toml: hash: differs, expected " + std::string(kOther) + ", got " + hash + "\n");
        // It can be looked at.
        CHECK(other.output == same.output);
        CHECK(folder.left() == std::vector<std::string>{"a.pfm"});
    }
}

TEST_CASE("expect-hash: a film has a hash for each frame that is rendered") {
    const ProgramFolder folder;
    const std::string film =
        "render s.toml -q -o a.pfm --set animation.frames=4 "
        "--set animation.camera_orbit_deg=[0,90] ";
    const std::vector<std::string> h = hashes_of(folder.run(film));
    REQUIRE(h.size() == 4);
    CHECK(h[0] != h[1]);
    const std::string all = h[0] + "," + h[1] + "," + h[2] + "," + h[3];
    CHECK(folder.run(film + "--expect-hash " + all).exit_status == 0);
    CHECK(folder.run(film + "--frames 1-2 --expect-hash " + h[1] + "," + h[2]).exit_status == 0);
    CHECK(folder.run(film + "--frames 3 --expect-hash " + h[3]).exit_status == 0);
    const Outcome swapped =
        folder.run(film + "--frames 1-3 --expect-hash " + h[2] + "," + h[1] + "," + h[3]);
    CHECK(swapped.exit_status == 1);
    CHECK(swapped.errors == "s.toml: frame 1: hash: differs, expected " + h[2] + ", got " + h[1] +
                                "\ns.toml: frame 2: hash: differs, expected " + h[1] + ", got " +
                                h[2] + "\n");
    CHECK(line_count(swapped.output) == 3);
}

TEST_CASE("expect-hash: what is no hash is refused before there is work, exit 2") {
    const ProgramFolder folder;
    const std::string hash = kOther, film = "--set animation.frames=3 ";
    const std::pair<std::string, const char*> faults[] = {
        {"--expect-hash ''", "--expect-hash: no hash, \"\", allowed: 16 hex digits, for several"},
        {"--expect-hash 0123456789abcde", "--expect-hash: no hash, \"0123456789abcde\""},
        {"--expect-hash 0123456789abcdef0", "--expect-hash: no hash, "},
        {"--expect-hash 0x23456789abcdef", "--expect-hash: no hash, "},
        {"--expect-hash hash.txt", "--expect-hash: no hash, \"hash.txt\""},
        {"--expect-hash " + hash + ",", "--expect-hash: no hash, \"\""},
        {"--expect-hash " + hash + "," + hash,
         "--expect-hash: hashes: wrong number, 2, allowed: 1, one for each frame"},
        {film + "--expect-hash " + hash, "--expect-hash: hashes: wrong number, 1, allowed: 3"},
        {film + "--frames 1-2 --expect-hash " + hash, "wrong number, 1, allowed: 2"},
    };
    for (const auto& fault : faults) {
        const std::string &options = fault.first, &said = fault.second;
        CAPTURE(options);
        const Outcome outcome = folder.run("render s.toml -o a.pfm " + options);
        CHECK(outcome.exit_status == 2);
        CHECK(outcome.output == "");
        CHECK(line_count(outcome.errors) == 1);
        CHECK_MESSAGE(holds(outcome.errors, said), outcome.errors);
    }
    const Outcome blocks = folder.run("render s.toml --blocks b --expect-hash " + hash);
    CHECK(blocks.exit_status == 2);
    CHECK(blocks.errors == "--blocks: together with --expect-hash, allowed: without\n");
    CHECK(folder.left().empty());
}
