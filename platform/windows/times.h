// SPDX-License-Identifier: Apache-2.0
// What a process of ours cost. in: its HANDLE -> out: see clock.h; 0 where unknown.
#pragma once
namespace pileus {
double cpu_seconds_of(void* process);
long long peak_bytes_of(void* process);
}  // namespace pileus
