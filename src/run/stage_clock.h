// SPDX-License-Identifier: Apache-2.0
// The time of a stage: a flight, which has no clock, is compiled with a header in place of this.
// in: a scope -> out: its time in the report. docs/report.md; docs/flight.md, "Build"
#pragma once

namespace pileus {

struct Context;
struct Report;

/// Adds the time of its scope to the stage of that name.
class StageClock {
public:
    StageClock(const Context& context, const char* stage);
    ~StageClock();
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

private:
    Report* report_;
    const char* stage_;
    double wall_, cpu_;
};

}  // namespace pileus
