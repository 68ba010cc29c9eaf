// SPDX-License-Identifier: Apache-2.0
// Whether the user asked the program to end, by Ctrl-C (SIGINT) or SIGTERM.
// in: signals -> out: one flag, read between two pieces of work.
// docs/program.md, "Interrupting"; docs/architecture.md, floor 0
#pragma once
namespace pileus {

/// From now on the first of these signals only sets the flag; a second ends the process as ever.
/// A signal that the parent process had ignored stays ignored.
void catch_interrupts();

bool interrupt_asked();

}  // namespace pileus
