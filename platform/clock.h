// SPDX-License-Identifier: Apache-2.0
// Seconds for reports; no time ever reaches a pixel.
#pragma once
namespace pileus {
double wall_seconds();          ///< monotonic
double cpu_seconds();           ///< of the whole process, all threads
long long peak_memory_bytes();  ///< highest resident size of the process so far; 0 where unknown
bool stderr_is_terminal();
}  // namespace pileus
