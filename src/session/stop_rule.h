// SPDX-License-Identifier: Apache-2.0
// When the light of a frame is enough: passes that grow, and the ways in which they end.
// in: a method's goal, what is held, times -> out: units of the next pass.
// docs/program.md, "Budgets of a path tracing"
#pragma once
#include "src/methods/method.h"

namespace pileus {

/// The last that was traced; 0 units: none yet.
struct LightPass {
    std::uint64_t units = 0;
    double seconds = 0;
};

class StopRule {
public:
    explicit StopRule(const LightGoal& goal) : goal_(goal) {}

    /// Numbers of units at which the error is looked at: the goal's first one, and each a quarter
    /// more than the one before, rounded down, or twice it. A run that was stopped and resumed
    /// therefore ends where one without a break does.
    bool is_look(std::uint64_t units) const;
    std::uint64_t next_look(std::uint64_t units) const;

    /// Whether `met` has to know the error.
    bool wants_error(const LightUnits& light) const;
    /// There is as much light as is wanted, or may be.
    bool met(const LightUnits& light, double error) const;
    /// Units of the next pass while it is not met; 0: `spent_s` is about as much as there is. One,
    /// or in passes about half a second of them, at most twice the last, not over the next look at
    /// the error, and not over the most.
    std::uint64_t next(const LightUnits& light, double spent_s, const LightPass& last) const;
    /// How far it is, by what will end it first.
    double share_done(const LightUnits& light, double spent_s) const;

private:
    LightGoal goal_;
};

}  // namespace pileus
