// SPDX-License-Identifier: Apache-2.0
// Runs one body of work on several threads: OpenMP's, our own, or the caller's alone.
// in: a count and a body -> out: the body ran here, and on whoever came before it was done.
// docs/performance.md, "Waiting"; a build without threads has team_serial.cpp alone
#pragma once
#include <cstdint>

namespace pileus {

/// Whose threads. kAllowed: OpenMP's where they are known to sleep while they wait, else our own.
enum class TeamKind : std::uint8_t { kAllowed, kOpenMp, kOwn, kSerial };

using TeamBody = void (*)(void* data, std::uint32_t index);

/// What a pool keeps from one loop to the next; null: nothing yet, and kAllowed.
struct Team;

/// Calls body(data, 0) here and body(data, i), 0 < i < count, on threads that come before this one
/// is done; returns when all have returned. Bodies throw nothing.
void run_team(Team*& team, std::uint32_t count, TeamBody body, void* data);
void end_team(Team* team);

/// Null where memory ends.
Team* make_team(TeamKind kind);
/// For people: "openmp (passive)", "own" or "serial".
const char* team_name(const Team* team);

}  // namespace pileus
