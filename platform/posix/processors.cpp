// SPDX-License-Identifier: Apache-2.0
// See processors.h.
#include "platform/team/processors.h"

#ifdef __linux__
#include <sched.h>
#endif

#include <cstdlib>
#include <sstream>
#include <vector>

namespace pileus {
namespace {

/// Where a process is in one of the two kinds of groups, and where that kind is seen in the files.
struct GroupPlace {
    bool here = false;
    std::string group;         ///< from the root of all groups
    std::string mount, shown;  ///< folder, and the group that it shows
};

std::vector<std::string> split_at(const std::string& text, char mark) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, mark);) parts.push_back(part);
    return parts;
}

bool names_cpu(const std::string& list) {
    for (const std::string& name : split_at(list, ','))
        if (name == "cpu") return true;
    return false;
}

/// /proc/self/cgroup: "0::/path" of version 2, "4:cpu,cpuacct:/path" of version 1.
void read_groups(const std::string& text, GroupPlace& one, GroupPlace& two) {
    for (const std::string& line : split_at(text, '\n')) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first == std::string::npos ? first : first + 1);
        if (second == std::string::npos) continue;
        const std::string names = line.substr(first + 1, second - first - 1);
        if (names.empty() || names_cpu(names)) {
            GroupPlace& place = names.empty() ? two : one;
            place.here = true;
            place.group = line.substr(second + 1);
        }
    }
}

/// /proc/self/mountinfo: "31 23 0:28 /shown /mount options - type source options".
void read_mounts(const std::string& text, GroupPlace& one, GroupPlace& two) {
    for (const std::string& line : split_at(text, '\n')) {
        const std::size_t dash = line.find(" - ");
        if (dash == std::string::npos) continue;
        const std::vector<std::string> before = split_at(line.substr(0, dash), ' ');
        const std::vector<std::string> after = split_at(line.substr(dash + 3), ' ');
        if (before.size() < 5 || after.size() < 3) continue;
        const bool is_two = after[0] == "cgroup2";
        if (!is_two && (after[0] != "cgroup" || !names_cpu(after[2]))) continue;
        GroupPlace& place = is_two ? two : one;
        if (!place.mount.empty()) continue;
        place.shown = before[3];
        place.mount = before[4];
    }
}

/// Processors' time, rounded up; 0: no limit.
int quota(const std::string& most, const std::string& period) {
    const double time = std::strtod(most.c_str(), nullptr);
    const double of = std::strtod(period.c_str(), nullptr);
    if (!(time > 0) || !(of > 0)) return 0;
    const double whole = time / of;
    if (whole >= 1e6) return 0;
    return int(whole) + (double(int(whole)) < whole);
}

int limit_at(const std::string& folder, bool is_two) {
    if (!is_two)
        return quota(machine_text(folder + "/cpu.cfs_quota_us"),
                     machine_text(folder + "/cpu.cfs_period_us"));
    const std::vector<std::string> words = split_at(machine_text(folder + "/cpu.max"), ' ');
    return words.size() < 2 ? 0 : quota(words[0], words[1]);  // "max 100000": no limit
}

int least(int a, int b) { return a == 0 || (b != 0 && b < a) ? b : a; }

/// From the process's own group up to the one that the mount shows.
int limit_of(const std::string& root, const GroupPlace& place, bool is_two) {
    if (!place.here || place.mount.empty()) return 0;
    std::string below = place.group;
    if (place.shown != "/") {
        const bool within = below.compare(0, place.shown.size(), place.shown) == 0;
        below = within ? below.substr(place.shown.size()) : "";
    }
    // Groups outside of what this process is shown.
    if (below.find("/..") != std::string::npos) below.clear();
    int limit = 0;
    for (;;) {
        limit = least(limit, limit_at(root + place.mount + below, is_two));
        const std::size_t slash = below.rfind('/');
        if (slash == std::string::npos) return limit;
        below.resize(slash);
    }
}

}  // namespace

int allowed_processors() {
#ifdef __linux__
    cpu_set_t own;
    const int count = ::sched_getaffinity(0, sizeof own, &own) == 0 ? CPU_COUNT(&own) : 0;
    return least(count, group_processors(""));
#else
    return 0;
#endif
}

int group_processors(const std::string& root) {
    GroupPlace one, two;
    read_groups(machine_text(root + "/proc/self/cgroup"), one, two);
    if (!one.here && !two.here) return 0;
    read_mounts(machine_text(root + "/proc/self/mountinfo"), one, two);
    return least(limit_of(root, one, false), limit_of(root, two, true));
}

}  // namespace pileus
