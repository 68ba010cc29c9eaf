// SPDX-License-Identifier: Apache-2.0
// Whether each thread adds photons to sums of its own or all add to one set.
// in: what the scene asks for, threads, bytes of one set, the limit of memory -> out: which, why.
// docs/collectors.md, "Accumulation"; docs/determinism.md: both ways give the same bits.
#pragma once
#include <cstdint>
#include <string>

#include "src/scene/scene.h"

namespace pileus {

/// How the threads of a run add up what their photons leave behind.
struct Accumulation {
    std::string kind;         ///< "direct", "private" or "shared"
    std::string why;          ///< for people, with the numbers that decided
    std::uint64_t bytes = 0;  ///< of private sums, all threads; an upper bound where `set_bytes` is
    bool shared = false;      ///< sums are added to atomically
};

/// What the decision rests on, in bytes.
struct AccumulationSizes {
    std::uint64_t threads = 1, set = 0;   ///< of one thread's own sums
    std::uint64_t others = 0, limit = 0;  ///< peak of all other arrays; limit of memory
    bool exact = false;                   ///< false: `set` and `others` are upper bounds
};

/// Private sums may take a quarter of the limit of memory, and no more than the others leave of it.
/// One thread needs neither way: it adds to the total.
Accumulation plan_accumulation(AccumulationChoice choice, const AccumulationSizes& sizes);

}  // namespace pileus
