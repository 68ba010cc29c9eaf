// SPDX-License-Identifier: Apache-2.0
// See team.h, teams.h and threads.h: of builds with threads.
#include "platform/team/teams.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <thread>

#include "platform/team/processors.h"
#include "platform/team/team_own.h"
#include "platform/threads.h"

namespace pileus {
namespace {

/// Of two values of the environment, null where they are not there.
bool is_passive(const char* policy, const char* spins) {
    if (spins != nullptr) return std::strcmp(spins, "0") == 0;
    return policy != nullptr &&
           (std::strcmp(policy, "passive") == 0 || std::strcmp(policy, "PASSIVE") == 0);
}

/// The value of a name among the words, each ended by a zero, that a process began with.
const char* value_of(const std::string& words, const char* name) {
    const std::size_t length = std::strlen(name);
    for (std::size_t at = 0; at < words.size(); at += std::strlen(words.c_str() + at) + 1) {
        const char* word = words.c_str() + at;
        if (std::strncmp(word, name, length) == 0 && word[length] == '=') return word + length + 1;
    }
    return nullptr;
}

TeamKind team_of(TeamKind wanted, bool forked) {
    if (wanted == TeamKind::kOwn || wanted == TeamKind::kSerial) return wanted;
#if PILEUS_WITH_OPENMP
    const bool sleeps = wanted == TeamKind::kOpenMp || openmp_is_passive();
    if (sleeps && !forked && !is_forked()) return TeamKind::kOpenMp;
#endif
    (void)forked;
    return TeamKind::kOwn;
}

}  // namespace

bool openmp_is_passive() {
    constexpr const char* kPolicy = "OMP_WAIT_POLICY";
    constexpr const char* kSpins = "GOMP_SPINCOUNT";
    if (!is_passive(std::getenv(kPolicy), std::getenv(kSpins))) return false;
    const std::string first = machine_text("/proc/self/environ");
    return is_passive(value_of(first, kPolicy), value_of(first, kSpins));
}

bool is_forked() {
    // proc(5): after the name in parentheses the flags are the seventh word; PF_FORKNOEXEC.
    constexpr unsigned long kForkNoExec = 0x40;
    const std::string text = machine_text("/proc/self/stat");
    std::size_t at = text.rfind(')');
    for (int word = 0; word < 7 && at != std::string::npos; ++word) at = text.find(' ', at + 1);
    return at == std::string::npos ||
           (std::strtoul(text.c_str() + at, nullptr, 10) & kForkNoExec) != 0;
}

int hardware_threads() {
    const int allowed = allowed_processors();
    const int count = allowed > 0 ? allowed : int(std::thread::hardware_concurrency());
    return count > 1 ? count : 1;
}

struct Team {
    const pid_t process = ::getpid();
    const TeamKind wanted;
    TeamKind kind;
    std::atomic<bool> busy{false};
    OwnTeam own;
    std::uint32_t openmp_threads = 0;  ///< of the largest loop

    Team(TeamKind kind_wanted, bool forked)
        : wanted(kind_wanted), kind(team_of(kind_wanted, forked)) {}
    void run(std::uint32_t count, TeamBody body, void* data);
};

void Team::run(std::uint32_t count, TeamBody body, void* data) {
#if PILEUS_WITH_OPENMP
    if (kind == TeamKind::kOpenMp && count > openmp_threads) {
        // OpenMP ends the process where it gets no threads: see whether there are so many.
        if (OwnTeam().grow(count - 1))
            openmp_threads = count;
        else
            kind = TeamKind::kOwn;
    }
    if (kind == TeamKind::kOpenMp) return run_on_openmp(openmp_threads, count, body, data);
#endif
    own.run(count, body, data);
}

void run_team(Team*& team, std::uint32_t count, TeamBody body, void* data) {
    if (count < 2) return body(data, 0);
    // A process that was forked has a copy of what its parent's threads were at, and no thread.
    const bool forked = team != nullptr && team->process != ::getpid();
    if (team == nullptr || forked)
        team = new (std::nothrow) Team(forked ? team->wanted : TeamKind::kAllowed, forked);
    // A team that is at work, as within one of its own bodies, has the caller do all.
    if (team == nullptr || team->kind == TeamKind::kSerial || team->busy.exchange(true))
        return body(data, 0);
    team->run(count, body, data);
    team->busy = false;
}

void end_team(Team* team) {
    if (team != nullptr && team->process == ::getpid()) delete team;
}

Team* make_team(TeamKind kind) { return new (std::nothrow) Team(kind, false); }

const char* team_name(const Team* team) {
    switch (team != nullptr ? team->kind : team_of(TeamKind::kAllowed, false)) {
        case TeamKind::kOpenMp:
            return "openmp (passive)";
        case TeamKind::kSerial:
            return "serial";
        default:
            return "own";
    }
}

}  // namespace pileus
