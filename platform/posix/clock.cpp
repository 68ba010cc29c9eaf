// SPDX-License-Identifier: Apache-2.0
// See clock.h.
#include "platform/clock.h"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

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
    // The kernel's own count of this program; getrusage also counts what ran before it in this
    // process, a large parent for one.
    if (std::FILE* file = std::fopen("/proc/self/status", "r")) {
        char line[256];
        long long kilobytes = 0;
        while (kilobytes == 0 && std::fgets(line, sizeof line, file) != nullptr)
            if (std::strncmp(line, "VmHWM:", 6) == 0)
                kilobytes = std::strtoll(line + 6, nullptr, 10);
        std::fclose(file);
        if (kilobytes > 0) return kilobytes * 1024;
    }
    rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return static_cast<long long>(usage.ru_maxrss) * 1024;
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace pileus
