// SPDX-License-Identifier: Apache-2.0
// How many processors' time the groups that a process is in may take (Linux, cgroups).
// in: files below /proc and /sys/fs/cgroup -> out: a number of processors, rounded up.
// cgroups(7); kernel documentation, "Control Group v2", cpu.max; docs/program.md, "Threads"
#pragma once
#include <string>

namespace pileus {

/// The least of what the process's own group and those around it allow, at least 1; 0: no limit.
/// `root` stands before every path; empty for this machine.
int group_processors(const std::string& root);

}  // namespace pileus
