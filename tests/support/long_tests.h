// SPDX-License-Identifier: Apache-2.0
// Whether the longer versions of tests were asked for.
// in: environment variable PILEUS_LONG_TESTS -> out: yes where it is 1.
// docs/testing.md, "Run"
#pragma once
#include <cstdlib>
#include <cstring>

namespace pileus {

inline bool long_tests() {
    const char* wanted = std::getenv("PILEUS_LONG_TESTS");
    return wanted != nullptr && std::strcmp(wanted, "1") == 0;
}

}  // namespace pileus
