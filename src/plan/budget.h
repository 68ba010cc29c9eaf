// SPDX-License-Identifier: Apache-2.0
// When the tracing of a frame ends, instead of what the scene says.
// in: options of a program -> out: numbers that a method takes, each those kinds that it knows.
// docs/program.md
#pragma once
#include <cstdint>
#include <string>

namespace pileus {

struct Budget {
    std::int64_t photons = -1;     ///< >= 0: so many
    std::int64_t generations = 0;  ///< > 0: so many of the scene's, each of as many photons
    std::int64_t samples = -1;     ///< >= 1: so many paths for each pixel
    std::int64_t steps = -1;       ///< >= 0: so many of a ray
    double error = 0;              ///< > 0: the mean relative standard error to reach
    double seconds = 0;            ///< > 0: wall time; chooses only a whole number of passes
    std::string state;             ///< file that keeps a path tracer's progress; empty: none
    double state_every_s = 60;     ///< between two writings of it
};

/// The budgets as the program takes them, parted by blanks.
std::string budget_text(const Budget& budget);

}  // namespace pileus
