// SPDX-License-Identifier: Apache-2.0
// Whether the user asked the program to end, by Ctrl-C (SIGINT) or SIGTERM.
// in: signals -> out: one flag, read between two pieces of work, or the end.
// docs/program.md, "Interrupting"; docs/architecture.md, floor 0
#pragma once
namespace pileus {

/// From now on the first of these signals sets the flag, or, where nothing is to be lost, ends the
/// process at once with the line `last_words` (at most 120 characters) and `exit_status`. A second
/// ends it as ever. A signal that the parent process had ignored stays ignored.
void catch_interrupts(const char* last_words, int exit_status);

/// Whether an end now would lose something; false at first.
void hold_interrupts(bool hold);

bool interrupt_asked();

}  // namespace pileus
