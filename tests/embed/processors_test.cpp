// SPDX-License-Identifier: Apache-2.0
// How many processors a container's limit is: both kinds of groups, and groups around groups.
// in: files as the system shows them -> out: checks.
// cgroups(7); kernel documentation, "Control Group v2", cpu.max
#include "platform/team/processors.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "platform/threads.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

/// A machine whose files lie in a folder.
struct Shown {
    test::TempFolder folder;

    Shown(const std::string& groups, const std::string& mounts) {
        put("proc/self/cgroup", groups);
        put("proc/self/mountinfo", mounts);
    }
    void put(const std::string& name, const std::string& text) const {
        namespace fs = std::filesystem;
        fs::create_directories(fs::path(folder.path(name)).parent_path());
        folder.put(name, text);
    }
    int processors() const { return group_processors(folder.path("")); }
};

const char* const kMount2 =
    "24 1 0:22 / /proc rw - proc proc rw\n"
    "31 23 0:28 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";

}  // namespace

TEST_CASE("processors: no groups, no limit") {
    CHECK(group_processors("/nowhere/at/all") == 0);
    const Shown none("0::/user.slice\n", kMount2);
    CHECK(none.processors() == 0);
    none.put("sys/fs/cgroup/user.slice/cpu.max", "max 100000\n");
    CHECK(none.processors() == 0);
    CHECK(hardware_threads() >= 1);
}

TEST_CASE("processors: the least of a group and those around it, rounded up") {
    const Shown shown("0::/a.slice/b.service\n", kMount2);
    shown.put("sys/fs/cgroup/a.slice/b.service/cpu.max", "max 100000\n");
    shown.put("sys/fs/cgroup/a.slice/cpu.max", "250000 100000\n");
    CHECK(shown.processors() == 3);  // 2.5
    shown.put("sys/fs/cgroup/a.slice/b.service/cpu.max", "400000 100000\n");
    CHECK(shown.processors() == 3);
    shown.put("sys/fs/cgroup/a.slice/b.service/cpu.max", "50000 100000\n");
    CHECK(shown.processors() == 1);  // 0.5
    shown.put("sys/fs/cgroup/a.slice/b.service/cpu.max", "20000 10000\n");
    CHECK(shown.processors() == 2);
    // The root has no limit of its own, but a container's root is a group of the machine.
    shown.put("sys/fs/cgroup/cpu.max", "1000 100000\n");
    CHECK(shown.processors() == 1);
}

TEST_CASE("processors: groups of version 1, with version 2 beside them") {
    const Shown shown("12:cpuset:/x\n4:cpu,cpuacct:/docker/f00\n0::/elsewhere\n",
                      "31 23 0:28 / /sys/fs/cgroup ro - tmpfs tmpfs ro\n"
                      "32 31 0:29 /docker/f00 /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
                      "33 31 0:30 /docker/f00 /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup "
                      "rw,cpu,cpuacct\n"
                      "34 31 0:31 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
    CHECK(shown.processors() == 0);
    // The mount shows the container's own group.
    const std::string folder = "sys/fs/cgroup/cpu,cpuacct/";
    shown.put(folder + "cpu.cfs_quota_us", "-1\n");
    shown.put(folder + "cpu.cfs_period_us", "100000\n");
    CHECK(shown.processors() == 0);
    shown.put(folder + "cpu.cfs_quota_us", "600000\n");
    CHECK(shown.processors() == 6);
    shown.put("sys/fs/cgroup/unified/elsewhere/cpu.max", "100001 100000\n");
    CHECK(shown.processors() == 2);
}

TEST_CASE("processors: groups out of sight, and files that hold something else") {
    const Shown outside("0::/../other\n", kMount2);
    outside.put("sys/fs/cgroup/cpu.max", "300000 100000\n");
    CHECK(outside.processors() == 3);
    const Shown odd("0::/\nnonsense\n:\n7:cpu\n", kMount2 + std::string("\n - \nodd - cgroup\n"));
    for (const char* text : {"", "\n", "100000", "x y\n", "0 100000\n", "-5 100000\n", "5 0\n",
                             "1e300 1\n", "nan nan\n"}) {
        CAPTURE(text);
        odd.put("sys/fs/cgroup/cpu.max", text);
        CHECK(odd.processors() == 0);
    }
}
