// SPDX-License-Identifier: Apache-2.0
// How the program ends: warnings and --strict, a signal before there is light.
// in: command lines, signals -> out: exit status, lines, files left behind.
// docs/program.md, "Interrupting"
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/run_program.h"

using namespace pileus;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

namespace {

using Names = std::vector<std::string>;

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a picture without the medium is written with a warning, and fails where that is asked") {
    const ProgramFolder folder;
    const std::string away =
        "render s.toml -o a.pfm --report r.json --set camera.target_m=[0,-600,50]";
    const Outcome outcome = folder.run(away);
    CHECK(outcome.exit_status == 0);
    CHECK(line_count(outcome.errors) == 1);
    CHECK(holds(outcome.errors, "warning: s.toml: no ray meets the medium"));
    const auto report = nlohmann::json::parse(folder.files().get("r.json"));
    REQUIRE(report["warnings"].size() == 1);
    CHECK(holds(outcome.errors, report["warnings"][0]));
    const Outcome strict = folder.run(away + " --strict");
    CHECK(strict.exit_status == 1);
    CHECK(strict.errors == outcome.errors);
    CHECK(folder.left() == Names{"a.pfm", "r.json"});
    CHECK(folder.run("render s.toml -o a.pfm --strict").exit_status == 0);
}

TEST_CASE("a warning is said once for all frames") {
    const ProgramFolder folder;
    const Outcome outcome = folder.run(
        "render s.toml -o a.pfm --strict --set camera.target_m=[0,-600,50] "
        "--set animation.frames=3");
    CHECK(outcome.exit_status == 1);
    CHECK(line_count(outcome.errors) == 1);
    CHECK(folder.left() == Names{"a.0000.pfm", "a.0001.pfm", "a.0002.pfm"});
}

TEST_CASE("a signal while a scene is prepared ends the program with a line") {
    const ProgramFolder folder;
    // Preparing 27 million voxels takes far longer than until the signal is there.
    folder.files().put("s.toml",
                       std::string(test::small_scene()) + "[output]\nfiles = [\"a.pfm\"]\n");
    const std::string line =
        "cd '" + folder.files().path("") +
        "' && exec \"$PILEUS_PROGRAM\" render s.toml --set medium.0.density=procedural:cumulus "
        "--set medium.0.resolution=[300,300,300] >.out 2>.err </dev/null";
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        (void)signal(SIGTERM, SIG_DFL);
        execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
        _exit(99);
    }
    // Until the program catches the signal: it then no longer has the default action.
    const std::string status_file = "/proc/" + std::to_string(child) + "/status";
    int status = 0;
    bool ended = false, caught = false;
    while (!ended && !caught) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ended = waitpid(child, &status, WNOHANG) == child;
        std::FILE* file = ended ? nullptr : std::fopen(status_file.c_str(), "r");
        char text[4096] = {};
        if (file == nullptr) continue;
        (void)!std::fread(text, 1, sizeof text - 1, file);
        (void)std::fclose(file);
        const std::string words = text;
        const std::size_t at = words.find("SigCgt:\t");
        if (at == std::string::npos) continue;
        // Before it became the program, the child has the tests' own handlers.
        char program[4096] = {};
        const std::string exe = "/proc/" + std::to_string(child) + "/exe";
        const bool known = readlink(exe.c_str(), program, sizeof program - 1) > 0;
        const bool ours = known && std::filesystem::path(program).filename() == "pileus";
        const auto handlers = std::stoull(words.substr(at + 8, 16), nullptr, 16);
        caught = ours && (handlers >> (SIGTERM - 1) & 1) != 0;
    }
    REQUIRE_FALSE(ended);
    REQUIRE(kill(child, SIGTERM) == 0);
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 1);
    CHECK(folder.files().get(".err") ==
          "interrupted before there was anything to keep; no file written\n");
    CHECK(folder.left().empty());
}
