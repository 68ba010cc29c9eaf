// SPDX-License-Identifier: Apache-2.0
// How many samples a film gets: passes that grow, and the three ways in which they end.
// in: the scene's [path] table, a budget, times -> out: samples of the next pass.
// docs/program.md, "Budgets of a path tracing"
#pragma once
#include <cstdint>

#include "src/methods/methods.h"

namespace pileus {

/// Tracing ends at the first of: so many samples, the error, the time.
struct PassRule {
    std::uint64_t most = 0;  ///< samples per pixel
    double error = 0;        ///< 0: none
    double seconds = 0;      ///< 0: none
};

/// `budget` wins over the scene; where an error or a time decides, max_samples_per_pixel bounds.
PassRule pass_rule(const PathSettings& settings, const Budget& budget);

/// Numbers of samples at which the error is looked at: 16 and each a quarter more than the one
/// before, rounded down. A run that was stopped and resumed therefore ends where one without a
/// break does.
bool is_check(std::uint64_t samples);
std::uint64_t next_check(std::uint64_t samples);

/// Samples of the next pass, at least 1: about half a second of them, at most twice the last, not
/// over the next look at the error, and not over the rule's most. `film` samples are there already,
/// fewer than the rule's most; the last pass added `last` (0: none yet) in `last_s`; `left_s` of
/// the rule's seconds are left.
std::uint64_t pass_samples(const PassRule& rule, std::uint64_t film, std::uint64_t last,
                           double last_s, double left_s);

}  // namespace pileus
