// SPDX-License-Identifier: Apache-2.0
// The program under a machine that runs out of memory, disk or files at every possible moment.
// in: the k-th call of a kind fails, once or from then on -> out: exit status, one line, no file.
// docs/testing.md, section Failing memory and disks
#include <doctest/doctest.h>

#include "tests/cli/run_program.h"

using namespace pileus;
using namespace pileus::test;

namespace {

constexpr const char* kArguments =
    "render s.toml -q --threads 1 -o a.exr b.png c.pfm --report r.json "
    "--set camera.resolution=[4,3] --set collectors.photons=40 --set collectors.samples=20 "
    "--set medium.0.density={file=\\\"v.raw\\\",type=\\\"uint8\\\",size=[2,2,2]}";

/// A folder in which the program can render, and older pictures that must survive its faults.
class Machine {
public:
    Machine() {
        const char* library = std::getenv("PILEUS_FAIL_LIBRARY");
        library_ = library != nullptr ? library : "";
        folder_.files().put("v.raw", "\1\2\3\4\5\6\7\10");
        reset();
    }
    bool ready() const { return !library_.empty(); }
    void reset() const {
        for (const char* name : {"a.exr", "b.png"}) folder_.files().put(name, "older");
        for (const char* name : {"c.pfm", "r.json"})
            std::filesystem::remove(folder_.files().path(name));
    }
    Outcome run(const std::string& kind, long at, const char* mode) const {
        const std::string before = "PILEUS_FAIL='" + kind + " " + std::to_string(at) + " " + mode +
                                   "' PILEUS_FAIL_COUNT=.count LD_PRELOAD='" + library_ + "'";
        return folder_.run(kArguments, before);
    }
    /// Calls of a kind that a run takes when none fails.
    long calls(const std::string& kind) const {
        const Outcome outcome = run(kind, 0, "once");
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        reset();
        return std::strtol(folder_.files().get(".count").c_str(), nullptr, 10);
    }
    /// Whether the folder is as it was before the run.
    bool untouched() const {
        std::vector<std::string> names = folder_.left();
        names.erase(std::remove(names.begin(), names.end(), ".count"), names.end());
        return names == std::vector<std::string>{"a.exr", "b.png", "v.raw"} &&
               folder_.files().get("a.exr") == "older" && folder_.files().get("b.png") == "older";
    }
    /// Whether all four files are there and none is the older one.
    bool complete() const {
        std::vector<std::string> names = folder_.left();
        names.erase(std::remove(names.begin(), names.end(), ".count"), names.end());
        return names == std::vector<std::string>{"a.exr", "b.png", "c.pfm", "r.json", "v.raw"} &&
               folder_.files().get("a.exr").substr(0, 4) == "\x76\x2f\x31\x01" &&
               folder_.files().get("b.png").substr(1, 3) == "PNG" &&
               folder_.files().get("c.pfm").size() == 12 * 12 + 10 &&
               folder_.files().get("r.json").back() == '\n';
    }

private:
    ProgramFolder folder_;
    std::string library_;
};

/// One failure: either nobody noticed and all is there, or one line, the status and nothing.
void check_failure(const Machine& machine, const std::string& kind, long at, const char* mode,
                   const std::vector<int>& allowed) {
    const Outcome outcome = machine.run(kind, at, mode);
    CAPTURE(kind);
    CAPTURE(at);
    CAPTURE(mode);
    CAPTURE(outcome.errors);
    CHECK(std::find(allowed.begin(), allowed.end(), outcome.exit_status) != allowed.end());
    if (outcome.exit_status == 0) {
        CHECK(machine.complete());
        CHECK(outcome.errors == "");
    } else {
        CHECK(machine.untouched());
        CHECK(line_count(outcome.errors) == 1);
        CHECK(outcome.output == "");
    }
    machine.reset();
}

bool missing(const Machine& machine) {
    if (!machine.ready()) MESSAGE("skipped: PILEUS_FAIL_LIBRARY is not set in this build");
    return !machine.ready();
}

}  // namespace

TEST_CASE("hostile: every allocation that fails is exit 3, one line and no file") {
    const Machine machine;
    if (missing(machine)) return;
    const long calls = machine.calls("memory");
    MESSAGE("allocations: " << calls);
    REQUIRE(calls > 300);
    // All of them take minutes; the first ones, where most kinds of callers are, a stride, and the
    // last ones, when files get their names.
    const bool all = std::getenv("PILEUS_LONG_TESTS") != nullptr;
    const long stride = all ? 1 : calls / 60 + 1;
    for (long at = 1; at <= calls;
         at += at < 60 || at + 20 > calls ? 1 : std::min(stride, calls - 19 - at))
        for (const char* mode : {"once", "always"})
            check_failure(machine, "memory", at, mode, {0, 3});
}

TEST_CASE("hostile: every failing write, sync, close and naming is exit 4, older files stay") {
    const Machine machine;
    if (missing(machine)) return;
    // Where every naming fails from some point on, files cannot be taken back either: that is tried
    // from the first on only.
    for (const char* kind : {"open", "write", "sync", "close", "name", "folder"}) {
        const long calls = machine.calls(kind);
        CAPTURE(kind);
        // One or more of each for four files; no folder needs to be made here.
        CHECK(calls >= (kind == std::string("folder") ? 0 : 4));
        for (long at = 1; at <= calls; ++at)
            for (const char* mode : {"once", "always"})
                if (kind != std::string("name") || mode == std::string("once") || at == 1)
                    check_failure(machine, kind, at, mode, {0, 4});
    }
    // These can be overcome by no other way: whatever call fails is told.
    for (const char* kind : {"write", "sync"}) check_failure(machine, kind, 1, "once", {4});
    check_failure(machine, "open", 1, "always", {4});
    check_failure(machine, "name", 1, "always", {4});
}

TEST_CASE("hostile: a write that takes only half is continued") {
    const Machine machine;
    if (missing(machine)) return;
    for (long at = 1; at <= 4; ++at)
        for (const char* mode : {"once", "always"})
            check_failure(machine, "short-write", at, mode, {0});
}

TEST_CASE("hostile: every failing read, and every file that ends too early, is exit 4") {
    const Machine machine;
    if (missing(machine)) return;
    const long reads = machine.calls("read");
    REQUIRE(reads >= 3);
    for (long at = 1; at <= reads; ++at) {
        check_failure(machine, "read", at, "once", {4});
        // The second read of the scene is the one that finds its end.
        check_failure(machine, "end", at, "once", {at == 2 ? 0 : 4});
    }
}
