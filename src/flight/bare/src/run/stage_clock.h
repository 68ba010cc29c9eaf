// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: a flight looks at no clock.
// in: nothing -> out: nothing. docs/flight.md, "Build"
#pragma once

namespace pileus {

struct Context;

struct StageClock {
    StageClock(const Context&, const char*) {}
    ~StageClock() {}
};

}  // namespace pileus
