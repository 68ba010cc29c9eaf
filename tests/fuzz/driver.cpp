// SPDX-License-Identifier: Apache-2.0
// One program for all fuzz targets: its first word, or else PILEUS_FUZZ_TARGET, names the target.
// in: a name, then what libFuzzer or replay.cpp takes -> out: theirs; 2 for an unknown name.
// docs/testing.md, section Fuzzing; libFuzzer's LLVMFuzzerInitialize
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerInitialize(int* count, char*** words);

namespace {

constexpr const char* kVariable = "PILEUS_FUZZ_TARGET";

struct Row {
    const char* name;
    int (*run)(const std::uint8_t* data, std::size_t size);
};
#define PILEUS_ROW(name) {#name, fuzz::name},
constexpr Row kRows[] = {PILEUS_FUZZ_TARGETS(PILEUS_ROW)};
#undef PILEUS_ROW

const Row* chosen = nullptr;

const Row* row_named(const char* name) {
    for (const Row& row : kRows)
        if (std::strcmp(row.name, name) == 0) return &row;
    return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
    const char* from = std::getenv(kVariable);
    const char* name = *count > 1 ? (*words)[1] : "";
    chosen = row_named(name);
    if (chosen != nullptr) {
        // The word is ours, not libFuzzer's, whose own processes find the variable.
        for (int i = 1; i + 1 < *count; ++i) (*words)[i] = (*words)[i + 1];
        --*count;
        (void)setenv(kVariable, chosen->name, 1);
    } else if (from != nullptr) {
        name = from;
        chosen = row_named(name);
    }
    if (chosen != nullptr) return 0;
    std::fprintf(stderr, "fuzz: no target \"%s\", allowed as first word:", name);
    for (const Row& row : kRows) std::fprintf(stderr, " %s", row.name);
    std::fprintf(stderr, "\n");
    std::exit(2);
}

/// ecCodes leaks a little of some damaged messages, which is not ours to mend.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libeccodes\n"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return chosen->run(data, size);
}
