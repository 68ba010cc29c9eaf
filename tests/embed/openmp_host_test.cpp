// SPDX-License-Identifier: Apache-2.0
// A host that computes by OpenMP itself: nothing waits for ever, and its threads stay its own.
// in: sessions between and within parallel regions -> out: checks; compiled with OpenMP.
// docs/embedding.md, "What the library asks of its host"
#include <omp.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "platform/team/teams.h"
#include "platform/threads.h"
#include "tests/embed/host_harness.h"

using namespace host_test;

namespace {

constexpr int kHostThreads = 3;
constexpr const char* kCloud =
    "[camera]\nposition_m = [0, -300, 50]\ntarget_m = [0, 0, 50]\nresolution = [32, 18]\n"
    "[sun]\nelevation_deg = 40\n[[medium]]\ndensity = \"uniform:box\"\n"
    "bounds_m = [[-50, -50, 0], [50, 50, 100]]\nextinction_per_m = 0.05\n";

/// What the host computes itself: 1 + ... + 1000 on its threads.
long host_sum(int& team) {
    long sum = 0;
#pragma omp parallel num_threads(kHostThreads) reduction(+ : sum)
    {
#pragma omp single
        team = omp_get_num_threads();
#pragma omp for
        for (int i = 1; i <= 1000; ++i) sum += i;
    }
    return sum;
}

std::string team_in_report(const Hosted& host) {
    std::string text(1 << 16, '\0');
    auto error = cleared<pileus_error>();
    if (pileus_session_report(host.session.get(), &text[0], text.size(), nullptr, &error) !=
        PILEUS_OK)
        return error.message;
    const std::size_t at = text.find("\"team\": \"") + 9;
    return text.substr(at, text.find('"', at) - at);
}

std::string wanted_team() {
    const char* team = std::getenv("PILEUS_WANTED_TEAM");
    return team != nullptr ? team : "own";
}

/// Whether the environment leaves OpenMP as it is, or this test has chosen it.
bool is_chosen() {
    if (std::getenv("PILEUS_WANTED_TEAM") != nullptr) return true;
    return std::getenv("OMP_WAIT_POLICY") == nullptr && std::getenv("GOMP_SPINCOUNT") == nullptr;
}

}  // namespace

TEST_CASE("OpenMP host: sessions between and within its regions, which keep their threads") {
    auto lent = cleared<pileus_host>();
    lent.threads = 2;
    Hosted alone(kCloud, {"method.name=\"raymarch\""}, &lent);
    const std::string hash = alone.hash();
    if (is_chosen()) {
        CHECK(pileus::ThreadPool().name() == wanted_team());
        CHECK(team_in_report(alone) == wanted_team());
    }
    for (int turn = 0; turn < 20; ++turn) {
        int team = 0;
        REQUIRE(host_sum(team) == 500500);
        REQUIRE(team == kHostThreads);
        REQUIRE(alone.hash() == hash);
    }
    // A session in each of its threads, at once.
    std::string hashes[kHostThreads];
#pragma omp parallel for num_threads(kHostThreads)
    for (int i = 0; i < kHostThreads; ++i) {
        pileus_session* session = nullptr;
        auto error = cleared<pileus_error>();
        auto frame = cleared<pileus_frame>();
        std::uint64_t number = 0;
        frame.hash = &number;
        if (pileus_session_create(alone.world.get(), alone.scene.get(), &lent, &session, &error) ==
            PILEUS_OK)
            for (int turn = 0; turn < 3; ++turn)
                (void)pileus_session_render(session, &frame, &error);
        pileus_session_free(session);
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
        hashes[i] = text;
    }
    for (const std::string& found : hashes) CHECK(found == hash);
    // A region of its own in a piece of ours, with either team.
    for (const pileus::TeamKind kind : {pileus::TeamKind::kOwn, pileus::TeamKind::kOpenMp}) {
        pileus::ThreadPool pool(kind);
        const pileus::PoolGuard guard(pool);
        long sums[4] = {};
        pileus::parallel_for(2, 4, [&](std::int64_t piece, int) {
            int team = 0;
            sums[piece] = host_sum(team);
        });
        for (const long sum : sums) CHECK(sum == 500500);
    }
}

TEST_CASE("OpenMP host: one whose threads sleep shares them, one that spins does not") {
    if (std::getenv("PILEUS_WANTED_TEAM") != nullptr) return;  // run by the lines below
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string test = " '" + self + "' --test-case='OpenMP host: sessions*' >/dev/null 2>&1";
    const struct {
        const char *environment, *team;
    } rows[] = {
        {"OMP_WAIT_POLICY=passive", "openmp (passive)"},
        {"OMP_WAIT_POLICY=PASSIVE", "openmp (passive)"},
        {"OMP_WAIT_POLICY=active GOMP_SPINCOUNT=0", "openmp (passive)"},
        {"OMP_WAIT_POLICY=passive GOMP_SPINCOUNT=1000", "own"},
        {"OMP_WAIT_POLICY=active", "own"},
        {"-u OMP_WAIT_POLICY -u GOMP_SPINCOUNT", "own"},
    };
    for (const auto& row : rows) {
        const std::string line =
            "env " + std::string(row.environment) + " PILEUS_WANTED_TEAM='" + row.team + "'" + test;
        CAPTURE(line);
        CHECK(std::system(line.c_str()) == 0);
    }
}

TEST_CASE("OpenMP host: what it says to itself once it runs is not believed") {
    if (!is_chosen() || std::getenv("PILEUS_WANTED_TEAM") != nullptr) return;
    REQUIRE(setenv("OMP_WAIT_POLICY", "passive", 1) == 0);
    const std::string name = pileus::ThreadPool().name();
    REQUIRE(unsetenv("OMP_WAIT_POLICY") == 0);
    CHECK(name == "own");
}
