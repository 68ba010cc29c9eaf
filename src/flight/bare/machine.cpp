// SPDX-License-Identifier: Apache-2.0
// A machine without clocks and files, as the flight library knows it.
// in: nothing -> out: times of 0; faults for whatever would read a file.
// docs/flight.md
#include "platform/clock.h"

namespace pileus {

double wall_seconds() { return 0; }
double cpu_seconds() { return 0; }
long long peak_memory_bytes() { return 0; }

}  // namespace pileus
