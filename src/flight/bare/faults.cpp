// SPDX-License-Identifier: Apache-2.0
// What a flight library says in place of checks of whole scenes and of readers of files.
// in: a value that is not sound for sure, a file -> out: one line.
// docs/flight.md
#include "src/session/value_fault.h"

namespace pileus {

Status check_changed(const char* key, const Scene&, void (*)(const void*, Scene&), const void*) {
    return Status::bad_input(std::string("session: ") + key +
                             ": refused in a flight, allowed: docs/flight.md, \"What may change\"");
}

}  // namespace pileus
