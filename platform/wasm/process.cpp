// SPDX-License-Identifier: Apache-2.0
// What a WebAssembly module has of process.h: no child processes, and signals that nobody sends.
// in: a command line -> out: a fault of the system.
// docs/web.md
#include "platform/process.h"

#include <cerrno>

namespace pileus {

InterruptHold::InterruptHold() = default;
InterruptHold::~InterruptHold() = default;

bool InterruptHold::pending() const { return false; }

ProcessResult run_process(const std::vector<std::string>&, const InterruptHold&,
                          const std::vector<std::string>&) {
    ProcessResult result;
    result.system_error = ENOSYS;
    return result;
}

char** begin_program(int&, char** words) { return words; }

std::string own_program(const char* first_word) { return first_word != nullptr ? first_word : ""; }

std::string processor_name() { return {}; }

}  // namespace pileus
