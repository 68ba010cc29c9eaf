// SPDX-License-Identifier: Apache-2.0
// See clock.h.
#include "platform/clock.h"

#include <windows.h>
// After the types of Windows.
#include <psapi.h>

#include "platform/windows/times.h"

namespace pileus {

double wall_seconds() {
    LARGE_INTEGER ticks, per_second;
    (void)::QueryPerformanceFrequency(&per_second);
    (void)::QueryPerformanceCounter(&ticks);
    return double(ticks.QuadPart) / double(per_second.QuadPart);
}

double cpu_seconds() { return cpu_seconds_of(::GetCurrentProcess()); }
long long peak_memory_bytes() { return peak_bytes_of(::GetCurrentProcess()); }

double cpu_seconds_of(void* process) {
    FILETIME began, ended, system, user;
    if (!::GetProcessTimes(process, &began, &ended, &system, &user)) return 0;
    const auto seconds = [](const FILETIME& time) {
        return 429.4967296 * double(time.dwHighDateTime) + 1e-7 * double(time.dwLowDateTime);
    };
    return seconds(system) + seconds(user);
}

long long peak_bytes_of(void* process) {
    PROCESS_MEMORY_COUNTERS counters = {};
    if (!::K32GetProcessMemoryInfo(process, &counters, sizeof counters)) return 0;
    return static_cast<long long>(counters.PeakWorkingSetSize);
}

bool stderr_is_terminal() {
    DWORD mode = 0;
    return ::GetConsoleMode(::GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

}  // namespace pileus
