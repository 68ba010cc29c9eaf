// SPDX-License-Identifier: Apache-2.0
// How many processors a process may use, and how much of their time the groups that it is in
// (Linux, cgroups). in: files below /proc and /sys/fs/cgroup -> out: a number of processors,
// rounded up. cgroups(7); kernel documentation, "Control Group v2", cpu.max; docs/program.md,
// "Threads"
#pragma once
#include <cstdio>
#include <string>

namespace pileus {

/// Those that this process may run on, of its group's time, too; 0 where the system does not tell.
int allowed_processors();

/// The least of what the process's own group and those around it allow, at least 1; 0: no limit.
/// `root` stands before every path; empty for this machine.
int group_processors(const std::string& root);

// What the system says of a process, as text: all of a file of /proc or /sys; empty where there is
// none.

inline std::string machine_text(const std::string& path) {
    std::string text;
    if (std::FILE* file = std::fopen(path.c_str(), "re")) {
        char block[4096];
        for (std::size_t got; (got = std::fread(block, 1, sizeof block, file)) > 0;)
            text.append(block, got);
        (void)std::fclose(file);
    }
    return text;
}

}  // namespace pileus
