// SPDX-License-Identifier: Apache-2.0
// See clock.h.
#include "platform/clock.h"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

namespace pileus {

namespace {
double seconds(clockid_t clock) {
    timespec t;
    clock_gettime(clock, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}
}  // namespace

double wall_seconds() { return seconds(CLOCK_MONOTONIC); }
double cpu_seconds() { return seconds(CLOCK_PROCESS_CPUTIME_ID); }

long long peak_memory_bytes() {
    rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return static_cast<long long>(usage.ru_maxrss) * 1024;
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace pileus
