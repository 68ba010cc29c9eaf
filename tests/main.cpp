// SPDX-License-Identifier: Apache-2.0
// The entry point of every test executable.
// in: doctest's command line -> out: exit 0 when every chosen case passed.
// tests/CMakeLists.txt links it once per folder of tests.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

// ecCodes keeps what it has read of a damaged message.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libeccodes\n"; }
