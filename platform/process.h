// SPDX-License-Identifier: Apache-2.0
// Runs another program to its end and tells what it cost; notices Ctrl-C without global state.
// in: a command line -> out: exit status, its last words, wall time, CPU time, memory.
// docs/study.md, "Runs"
#pragma once
#include <string>
#include <vector>

#include "platform/signal_mask.h"

namespace pileus {

struct ProcessResult {
    int system_error = 0;          ///< errno where the program could not be started; else 0
    int exit_status = -1;          ///< 128 + the signal's number where a signal ended it
    bool interrupted = false;      ///< ended by us, because an InterruptHold saw an interrupt
    std::string errors;            ///< start of its standard error, at most 64 KiB
    double wall_s = 0, cpu_s = 0;  ///< from its start to its end; CPU time of all its threads
    long long peak_bytes = 0;      ///< highest resident size
};

/// Holds back SIGINT, SIGTERM and SIGHUP, on Windows the console's control events, while it lives,
/// so that work can end in order; when it goes, a signal that came ends the program as if it came
/// then. One at a time, on one thread.
class InterruptHold {
public:
    InterruptHold();
    ~InterruptHold();
    InterruptHold(const InterruptHold&) = delete;
    InterruptHold& operator=(const InterruptHold&) = delete;

    /// Whether one of them has come.
    bool pending() const;
    /// The signals as they were before; for programs started meanwhile.
    const SignalMask& before() const { return before_; }

private:
    SignalMask before_;  // of POSIX
};

/// Runs `words[0]` with the words as its arguments to its end, in this environment but for
/// variables whose names begin as one of `hidden`. Its standard input and output are empty. An
/// interrupt that `hold` sees ends it at once.
ProcessResult run_process(const std::vector<std::string>& words, const InterruptHold& hold,
                          const std::vector<std::string>& hidden = {});

/// For the start of a program of ours, before it has threads: the words of its command line as
/// UTF-8, `count` of them. A reader of its output that goes away is a failed write from now on.
char** begin_program(int& count, char** words);

/// The file of the program that runs now; `first_word` (argv[0]) where the system does not tell.
std::string own_program(const char* first_word);

/// What the processor calls itself; empty where unknown.
std::string processor_name();

// Whether the user asked this program to end, by Ctrl-C (SIGINT, on Windows Ctrl-Break and a closed
// window as well) or SIGTERM: one flag, read between two pieces of work, or the end.
// docs/program.md, "Interrupting".

/// From now on the first of these signals sets the flag, or, where nothing is to be lost, ends the
/// process at once with the line `last_words` (at most 120 characters) and `exit_status`. A second
/// ends it as ever. A signal that the parent process had ignored stays ignored.
void catch_interrupts(const char* last_words, int exit_status);

/// Whether an end now would lose something; false at first.
void hold_interrupts(bool hold);

bool interrupt_asked();

}  // namespace pileus
