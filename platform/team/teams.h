// SPDX-License-Identifier: Apache-2.0
// Which team a process may have, and which one a program of ours takes.
// in: the environment -> out: a TeamKind.
// docs/performance.md, "Waiting"; docs/program.md, "Threads"
#pragma once
#include <cstdint>

#include "platform/team/team.h"

namespace pileus {

/// Whether what OpenMP read when the process began has its threads sleep at once: both what the
/// process was started with and what the environment says now.
bool openmp_is_passive();

/// Whether this process was forked from another and has not become a program of its own since;
/// OpenMP may hang in one.
bool is_forked();

/// What the environment variable PILEUS_TEAM asks for: openmp, own, serial; empty is kAllowed.
struct TeamChoice {
    TeamKind kind = TeamKind::kAllowed;
    const char* fault = nullptr;  ///< what is wrong with its value
    const char* allowed = "";     ///< names that this build has
};
constexpr const char* kTeamVariable = "PILEUS_TEAM";

/// For the start of a program of ours, before it has threads: the team that is asked for, else
/// OpenMP. Where OpenMP would spin the program begins anew, in an environment that says not to,
/// and this call does not return; where that cannot be done the team is our own.
TeamChoice start_team(char** words);

// OpenMP's threads, and whether they sleep while they wait.

/// Calls the body for [0, count) in a region of `threads`, at least `count`: libgomp ends threads
/// that a region does not need, and makes them anew for the next. Ends the process where OpenMP
/// gets no threads.
void run_on_openmp(std::uint32_t threads, std::uint32_t count, TeamBody body, void* data);

/// Gives this thread all processors back that it could run on before OpenMP bound it to one.
void unbind_from_openmp();

/// Whether the runtime can be told not to spin when the program runs already.
bool openmp_can_be_told();

}  // namespace pileus
