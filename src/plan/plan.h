// SPDX-License-Identifier: Apache-2.0
// What will run, what is left out and why, how much memory each array takes and when.
// in: a checked scene -> out: lists for people and for the report; the proof of the sums' bounds.
// docs/architecture.md, "Memory and errors"; docs/methods.md 2 "Accumulation".
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/limits.h"
#include "src/plan/accumulation.h"
#include "src/plan/memory_table.h"
#include "src/plan/plan_lists.h"
#include "src/plan/work.h"

namespace pileus {

/// What a picture's sums stay below, whatever the photons do.
constexpr double kLargestSum = 0x1p62;

/// Why a sum of integers cannot overflow: `addends` of at most `largest`, in quanta of 2^-places.
struct SumBound {
    std::string sum;
    double addends = 0, largest = 0;
    int places = 0;
    double worst = 0;  ///< the sum's largest size, in quanta
    double allowed = kLargestSum;
};

/// What a method errs by where no noise is left, and where that was measured.
struct BiasNote {
    std::string method, size, page;
};

/// What a limit is compared with.
struct LimitUse {
    LimitId id;
    std::uint64_t needs = 0, allowed = 0;
    bool known = true;  ///< false: what is needed shows only once the values are read
};

/// Wall time that a rendering is expected to take, of pictures beside files; 0: nobody asked.
struct ForetoldTime {
    double total_s = 0;              ///< of all frames
    double first_s = 0, next_s = 0;  ///< the first frame with its preparation, each further one
    double divided_s = 0;            ///< of the first what parts and ranks divide among them
};

struct Plan : PlanLists {
    std::vector<SumBound> bounds;
    BiasNote bias;
    Accumulation accumulation;  ///< no kind: nothing is accumulated in shared places
    MemoryTable memory;
    bool exact = false;  ///< false: `memory` holds upper bounds, made from sizes alone
    WorkEstimate work;
    const char* work_of = "photons";  ///< what `work` counts as photons
    std::vector<LimitUse> limits;
    ForetoldTime foretold;
    std::uint32_t stages_left_out = 0;  ///< a bit for each Stage that the method does not have

    bool runs(Stage stage) const { return (stages_left_out >> unsigned(stage) & 1u) == 0; }
    void skip(Stage stage) { stages_left_out |= 1u << unsigned(stage); }
};

/// Binary places of the fixed-point sums: the largest s <= 30 for which one deposit fits 31 bits
/// and `deposits` deposits of at most `largest` fit 62. Negative: no s >= 8 does, so refuse.
int fixed_point_places(double deposits, double largest);

/// The bound that fixed_point_places proves, written out.
SumBound deposit_bound(const char* sum, double deposits, double largest, int places);

}  // namespace pileus
