// SPDX-License-Identifier: Apache-2.0
// What files and children do through the calls of the system: the same lines on every one.
// in: nothing, in an empty folder -> out: lines; "child", "loud", "sleep": it is its own child.
// tools/windows compares two systems; docs/windows.md
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "platform/clock.h"
#include "platform/file_calls.h"
#include "platform/path.h"
#include "platform/process.h"

namespace {

using namespace pileus;

void say(const char* what, FileResult result) {
    std::printf("%s: %d %d\n", what, int(result.fault), result.error);
}

void show(const char* path) {
    InputFile file;
    const FileResult result = file.open(path);
    char bytes[64] = {};
    std::size_t got = 0;
    if (result) (void)file.read_some(bytes, sizeof bytes - 1, got);
    std::printf("%s: %d %d \"%s\"\n", path, int(result.fault), result.error, bytes);
}

void put(const char* path, const char* text) {
    say(path, replace_file(path, text, std::strlen(text)));
}

/// Published, and then taken back where it is not kept.
void publish(const char* path, const char* text, bool keep) {
    {
        NewFile file;
        FileResult result = file.begin(path);
        if (result) result = file.write(text, std::strlen(text));
        if (result) result = file.publish();
        say("published", result);
        show(path);
        if (keep) file.keep();
    }
    show(path);
}

void try_files() {
    put("a/b/ü☁/c.txt", "one");
    show("a/b/ü☁/c.txt");
    publish("a/b/ü☁/c.txt", "two, longer", false);
    publish("a/b/ü☁/c.txt", "three", true);
    publish("new/er/w.txt", "four", false);
    show("new");
    put("a", "a folder");
    show("none");
    NewFile file;
    FileResult result = file.begin("places.txt");
    if (result) result = file.write_at(4, "5678", 4);
    if (result) result = file.write_at(0, "1234", 4);
    if (result) result = file.flush();
    if (result) result = file.publish();
    file.keep();
    say("places", result);
    InputFile read;
    char bytes[7] = {};
    result = read.open("places.txt");
    if (result) result = read.read(bytes, 2);
    if (result) result = read.read_at(6, bytes + 2, 2);
    if (result) result = read.read(bytes + 4, 2);
    char past[4];
    std::printf("%s, past the end %d\n", bytes, int(read.read_at(6, past, 4).fault));
    for (const char* path :
         {"a", "a/b/x", "q/w/e", "places.txt", "places.txt/x", "places.txt/x/y", "a/b/", "d/"})
        say(path, check_replaceable(path));
    FileIdentity one, other;
    say("identity", identify_file("a/b/../b/ü☁/c.txt", one));
    say("identity", identify_file("./a/b/ü☁/c.txt", other));
    std::printf("one file %d, regular %d\n", one == other, one.regular);
    say("identity", identify_file("a/not/there.txt", one));
    say("identity", identify_file("./a/../a/not/there.txt", other));
    std::printf("one file %d, regular %d\n", one == other, one.regular);
}

void try_children() {
    const InterruptHold hold;
    const std::string own = own_program("");
    const auto run = [&](std::vector<std::string> words, const std::vector<std::string>& hidden) {
        words.insert(words.begin(), own);
        const ProcessResult result = run_process(words, hold, hidden);
        std::printf("%s: %d, status %d, %zu letters %.60s; time %d, memory %d\n", words[1].c_str(),
                    result.system_error, result.exit_status, result.errors.size(),
                    result.errors.size() < 60 ? result.errors.c_str() : "", result.wall_s > 0,
                    result.peak_bytes > 0);
    };
    run({"child", "a b", "q\"x\\", "\\\\", "", "ü☁"}, {});
    run({"child"}, {"PILEUS_HID"});
    run({"loud"}, {});
    std::printf("none: %d\n", run_process({"no/such"}, hold).system_error);
}

}  // namespace

int main(int count, char** words) {
    words = begin_program(count, words);
    const std::string role = count > 1 ? words[1] : "";
    if (role == "child") {
        for (int i = 2; i < count; ++i) std::fprintf(stderr, "[%s]", words[i]);
        std::fprintf(stderr, "%s", environment_text("PILEUS_HIDDEN").c_str());
        // Long enough to be looked at.
        for (const double began = wall_seconds(); wall_seconds() < began + 0.1;) continue;
        return 7;
    }
    if (role == "loud") {
        for (int i = 0; i < 3000; ++i) std::fputs("0123456789012345678901234567890\n", stderr);
        return 0;
    }
    if (role == "sleep") {
        for (const double began = wall_seconds(); wall_seconds() < began + 20;) continue;
        return 0;
    }
    if (role == "interrupted") {
        const InterruptHold hold;
        const ProcessResult result = run_process({own_program(""), "sleep"}, hold);
        std::printf("interrupted %d, at once %d\n", result.interrupted, result.wall_s < 15);
        std::fflush(stdout);
        std::_Exit(0);
    }
    try_files();
    try_children();
    return 0;
}
