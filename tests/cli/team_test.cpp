// SPDX-License-Identifier: Apache-2.0
// Whose threads the program uses: what it says of them, how it begins anew, the same pictures.
// in: PILEUS_TEAM, OpenMP's variables, ways to start a program -> out: lines, hashes, exit status.
// docs/program.md, "Threads"
#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "platform/team/processors.h"
#include "tests/cli/run_program.h"

using namespace pileus;
using test::Outcome;
using test::ProgramFolder;

namespace {

std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    if (at == std::string::npos) return "";
    const std::size_t begin = at + before.size();
    return text.substr(begin, text.find(after, begin) - begin);
}

/// What `pileus info` says after the number of threads.
std::string team_of(const Outcome& outcome) {
    const std::string line = between(outcome.output, "\nthreads ", "\n");
    return between(line + "\n", ", ", "\n");
}

/// Teams that the program was built with, as it names them itself.
std::string teams_of(const ProgramFolder& folder) {
    const Outcome refused = folder.run("info", "PILEUS_TEAM=none");
    CHECK(refused.exit_status == 2);
    CHECK(refused.output == "");
    CHECK(test::line_count(refused.errors) == 1);
    return between(refused.errors, "PILEUS_TEAM: unknown, \"none\", allowed: ", "\n");
}

bool has(const std::string& teams, const std::string& name) {
    return teams.find(name) != std::string::npos;
}

}  // namespace

TEST_CASE("team: OpenMP by default, its threads asleep while they wait, whatever it was told") {
    const ProgramFolder folder;
    const std::string teams = teams_of(folder);
    const std::string usual = has(teams, "openmp") ? "openmp (passive)"
                              : has(teams, "own")  ? "own"
                                                   : "serial";
    for (const char* before :
         {"env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT", "PILEUS_TEAM=", "OMP_WAIT_POLICY=active",
          "OMP_WAIT_POLICY=passive", "GOMP_SPINCOUNT=100000",
          "OMP_WAIT_POLICY=passive GOMP_SPINCOUNT=0 OMP_NUM_THREADS=1"}) {
        CAPTURE(before);
        const Outcome outcome = folder.run("info", before);
        CHECK(outcome.exit_status == 0);
        CHECK(outcome.errors == "");
        CHECK(team_of(outcome) == usual);
    }
    // A binding of OpenMP's first thread would leave one processor to all.
    const Outcome free = folder.run("info"), bound = folder.run("info", "OMP_PROC_BIND=true");
    CHECK(bound.output == free.output);
}

TEST_CASE("team: PILEUS_TEAM chooses it, and no picture shows which") {
    const ProgramFolder folder;
    const std::string teams = teams_of(folder);
    std::string hash;
    for (const std::string name : {"openmp", "own", "serial"}) {
        CAPTURE(name);
        const Outcome outcome = folder.run("render s.toml -q -o a.pfm --report r.json --threads 3",
                                           "PILEUS_TEAM=" + name);
        if (!has(teams, name)) {
            CHECK(outcome.exit_status == 2);
            CHECK(outcome.errors ==
                  "PILEUS_TEAM: not in this build, \"" + name + "\", allowed: " + teams + "\n");
            continue;
        }
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        const auto report = nlohmann::json::parse(folder.files().get("r.json"));
        const std::string team = report.value("team", "");
        CHECK(team == (name == "openmp" ? "openmp (passive)" : name));
        CHECK(report["threads"] == (name == "serial" ? 1 : 3));
        if (hash.empty()) hash = report["hash"];
        CHECK(report["hash"] == hash);
        CHECK(team_of(folder.run("info", "PILEUS_TEAM=" + name)) == team);
    }
    for (const char* wrong : {"OpenMP", "openmp,own", "2", "$(printf 'a\\nb')"}) {
        CAPTURE(wrong);
        const Outcome outcome = folder.run("info", std::string("PILEUS_TEAM=\"") + wrong + "\"");
        CHECK(outcome.exit_status == 2);
        CHECK(test::line_count(outcome.errors) == 1);
    }
}

TEST_CASE("team: beginning anew changes nothing that one sees of a program") {
    const ProgramFolder folder;
    const std::string fresh = "env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT";
    CHECK(folder.run("render none.toml", fresh).exit_status == 2);
    CHECK(folder.run("", fresh).exit_status == 2);
    CHECK(folder.run("render 's.toml' -q -o 'a b.pfm'", fresh).exit_status == 0);
    CHECK(folder.left() == std::vector<std::string>{"a b.pfm"});

    // Looked at while it waits for a scene.
    const std::string scene = folder.files().path("f.toml");
    REQUIRE(mkfifo(scene.c_str(), 0600) == 0);
    const int file = open(scene.c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(write(file, "seed = 7\n", 9) == 9);
    int input[2];
    REQUIRE(pipe(input) == 0);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        (void)unsetenv("OMP_WAIT_POLICY");
        (void)unsetenv("GOMP_SPINCOUNT");
        (void)signal(SIGUSR1, SIG_IGN);
        sigset_t blocked;
        (void)sigemptyset(&blocked);
        (void)sigaddset(&blocked, SIGUSR2);
        (void)sigprocmask(SIG_SETMASK, &blocked, nullptr);
        (void)dup2(input[0], 0);
        (void)dup2(open("/dev/null", O_WRONLY), 2);
        (void)execl(std::getenv("PILEUS_PROGRAM"), "other", "render", scene.c_str(), "-q",
                    static_cast<char*>(nullptr));
        _exit(99);
    }
    // It has read the first line.
    int status = 0, waiting = 9;
    for (int i = 0; i < 6000 && waiting > 0; ++i) {
        REQUIRE(ioctl(file, FIONREAD, &waiting) == 0);
        (void)usleep(10000);
    }
    REQUIRE(waiting == 0);
    const std::string place = "/proc/" + std::to_string(child);
    const std::string words = pileus::machine_text(place + "/cmdline");
    CHECK(words == std::string("other\0render\0", 13) + scene + std::string("\0-q\0", 4));
    CHECK(pileus::machine_text(place + "/comm") == "pileus\n");
    const std::string state = pileus::machine_text(place + "/status");
    const auto has_signal = [&](const char* set, int number) {
        return (std::stoull(between(state, set, "\n"), nullptr, 16) >> (number - 1) & 1) != 0;
    };
    CHECK(has_signal("SigIgn:\t", SIGUSR1));
    CHECK(has_signal("SigBlk:\t", SIGUSR2));
    CHECK(std::filesystem::read_symlink(place + "/fd/0") ==
          std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(input[0])));
    if (has(teams_of(folder), "openmp"))
        CHECK(pileus::machine_text(place + "/environ").find("GOMP_SPINCOUNT=0") !=
              std::string::npos);
    CHECK(write(file, "wrong = 1\n", 10) == 10);
    (void)close(file);
    (void)close(input[0]);
    (void)close(input[1]);
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 2);
}

TEST_CASE("team: where the program cannot begin anew it has threads of its own") {
    const ProgramFolder folder;
    const char* loader = "/lib64/ld-linux-x86-64.so.2";
    if (!has(teams_of(folder), "openmp") || !std::filesystem::exists(loader)) return;
    const std::string by_hand = std::string("env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT ") + loader;
    const Outcome outcome = folder.run("info", by_hand);
    CHECK(outcome.exit_status == 0);
    CHECK(team_of(outcome) == "own");
    const Outcome asked = folder.run("info", "PILEUS_TEAM=openmp " + by_hand);
    CHECK(asked.exit_status == 2);
    CHECK(asked.errors ==
          "PILEUS_TEAM: cannot be had here, \"openmp\", allowed: openmp, own, serial\n");
}
