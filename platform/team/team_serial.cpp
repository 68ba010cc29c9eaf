// SPDX-License-Identifier: Apache-2.0
// The team of builds without threads, flights among them: the caller alone.
// in, out: see team.h.
#include "platform/team/team.h"
#include "platform/threads.h"

namespace pileus {

int hardware_threads() { return 1; }

void run_team(Team*&, std::uint32_t, TeamBody body, void* data) { body(data, 0); }

void end_team(Team*) {}

Team* make_team(TeamKind) { return nullptr; }

const char* team_name(const Team*) { return "serial"; }

}  // namespace pileus
