// SPDX-License-Identifier: Apache-2.0
// OpenMP's threads, and whether they sleep while they wait.
// in: a count and a body; the environment -> out: see team.h.
// docs/performance.md, "Waiting"
#pragma once
#include <cstdint>

#include "platform/team/team.h"

namespace pileus {

/// Calls the body for [0, count) in a region of `threads`, at least `count`: libgomp ends threads
/// that a region does not need, and makes them anew for the next. Ends the process where OpenMP
/// gets no threads.
void run_on_openmp(std::uint32_t threads, std::uint32_t count, TeamBody body, void* data);

/// Gives this thread all processors back that it could run on before OpenMP bound it to one.
void unbind_from_openmp();

/// Whether the runtime can be told not to spin when the program runs already.
bool openmp_can_be_told();

}  // namespace pileus
