// SPDX-License-Identifier: Apache-2.0
// Whether the longer versions of tests were asked for.
// in: environment variables PILEUS_LONG_TESTS and PILEUS_ALL_ROWS -> out: yes where they are 1.
// docs/testing.md, "Run"
#pragma once
#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace pileus {

inline bool is_one(const char* variable) {
    const char* wanted = std::getenv(variable);
    return wanted != nullptr && std::strcmp(wanted, "1") == 0;
}

inline bool long_tests() { return is_one("PILEUS_LONG_TESTS"); }

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kRowsApart = 3;
#else
constexpr std::size_t kRowsApart = 1;
#endif

/// Rows that the plain form takes of a long table: every `plain`-th, of these every third under
/// sanitizers; all of them in the long form and where coverage is counted.
inline std::size_t row_stride(std::size_t plain) {
    return long_tests() || is_one("PILEUS_ALL_ROWS") ? 1 : kRowsApart * plain;
}

}  // namespace pileus
