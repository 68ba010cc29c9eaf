// SPDX-License-Identifier: Apache-2.0
// Whole files: each fault once, and nothing left behind by a failed write.
// in: a fresh folder -> out: pass or fail.
// docs/testing.md, label io
#include "src/base/file.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

Span<const char> bytes_of(const std::string& text) { return {text.data(), text.size()}; }

}  // namespace

TEST_CASE("file: what was written is read back, parent folders are made") {
    const test::TempFolder folder;
    const std::string text("a\0b\nc", 5), path = folder.path("x/y/z.bin");
    REQUIRE(write_file(path, bytes_of(text)));
    Buffer<char> read;
    REQUIRE(read_whole_file(path, 5, read));
    CHECK(std::string(read.data(), read.size()) == text);
    CHECK(folder.entries() == 3);  // x, x/y and the file: no temporary is left

    REQUIRE(write_file(path, bytes_of("")));
    REQUIRE(read_whole_file(path, 5, read));
    CHECK(read.size() == 0);
}

TEST_CASE("file: reading names the fault") {
    const test::TempFolder folder;
    Buffer<char> read;
    const Status missing = read_whole_file(folder.path("none"), 100, read);
    CHECK(missing.code == Code::kBadInput);
    CHECK(holds(missing.message, "none: cannot read: no such file"));

    const Status directory = read_whole_file(folder.path(""), 100, read);
    CHECK(directory.code == Code::kBadInput);
    CHECK(holds(directory.message, "is a folder"));

    const Status device = read_whole_file("/dev/zero", 100, read);
    CHECK(device.code == Code::kBadInput);
    CHECK(holds(device.message, "not a regular file"));

    const Status large = read_whole_file(folder.put("six", "123456"), 5, read);
    CHECK(large.code == Code::kLimit);
    CHECK(holds(large.message, "6 bytes, allowed: at most 5"));

    CHECK(read_whole_file("", 5, read).code == Code::kBadInput);
    CHECK(read_whole_file(std::string("a\0b", 3), 5, read).code == Code::kBadInput);
}

TEST_CASE("file: a failed write returns kIo and leaves nothing new") {
    const test::TempFolder folder;
    folder.put("plain", "old");
    std::filesystem::create_directory(folder.path("folder.png"));

    const Status directory = write_file(folder.path("folder.png"), bytes_of("new"));
    CHECK(directory.code == Code::kIo);
    CHECK(holds(directory.message, "is a folder"));
    CHECK(write_file(folder.path("plain/inside"), bytes_of("new")).code == Code::kIo);
    CHECK(write_file("", bytes_of("new")).code == Code::kIo);
    CHECK(write_file(folder.path(std::string(300, 'n')), bytes_of("new")).code == Code::kIo);
    CHECK(folder.entries() == 2);
    CHECK(folder.get("plain") == "old");
}

TEST_CASE("file: a full device fails, stays a device, and gets no temporary beside it") {
    if (!std::filesystem::is_character_file("/dev/full")) {
        MESSAGE("skipped: this machine has no /dev/full");
        return;
    }
    const test::TempFolder folder;
    std::filesystem::create_symlink("/dev/full", folder.path("full"));
    const Status full = write_file(folder.path("full"), bytes_of("new"));
    CHECK(full.code == Code::kIo);
    CHECK(holds(full.message, "cannot write: No space left on device"));
    CHECK(folder.entries() == 1);
    CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("file: a write that fails half way keeps the old file and leaves no temporary") {
    const test::TempFolder folder;
    const std::string large(1 << 20, 'n');
    folder.put("picture", "old");

    // Let the system refuse file bytes above 64 KiB, then allow them again.
    rlimit before;
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit tight{1 << 16, before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &tight) == 0);
    const Status status = write_file(folder.path("picture"), bytes_of(large));
    const Status fresh = write_file(folder.path("fresh"), bytes_of(large));
    REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, handler);

    CHECK(status.code == Code::kIo);
    CHECK(fresh.code == Code::kIo);
    CHECK(holds(status.message, "picture: cannot write: File too large"));
    CHECK(folder.get("picture") == "old");
    CHECK(folder.entries() == 1);
}
TEST_CASE("file: writing through a symbolic link keeps the link") {
    const test::TempFolder folder;
    folder.put("real", "old");
    std::filesystem::create_symlink("real", folder.path("link"));
    REQUIRE(write_file(folder.path("link"), bytes_of("new")));
    CHECK(folder.get("real") == "new");
    CHECK(std::filesystem::is_symlink(folder.path("link")));
}

TEST_CASE("file: a link that leads nowhere gets the file that it names") {
    const test::TempFolder folder;
    namespace fs = std::filesystem;
    fs::create_symlink("made/real", folder.path("link"));
    fs::create_symlink("link", folder.path("far"));
    CHECK(can_write_file(folder.path("far")));
    REQUIRE(write_file(folder.path("far"), bytes_of("new")));
    CHECK(fs::is_symlink(folder.path("link")));
    CHECK(fs::is_symlink(folder.path("far")));
    CHECK(folder.get("made/real") == "new");
    CHECK(folder.entries() == 4);
    // A ring of links leads to no file.
    fs::create_symlink("b", folder.path("a"));
    fs::create_symlink("a", folder.path("b"));
    CHECK(can_write_file(folder.path("a")).code == Code::kIo);
    CHECK(write_file(folder.path("a"), bytes_of("new")).code == Code::kIo);
    CHECK(fs::is_symlink(folder.path("a")));
}

TEST_CASE("file: a file that is written again keeps its permissions") {
    const test::TempFolder folder;
    namespace fs = std::filesystem;
    for (const int mode : {0600, 0640, 0666, 0755}) {
        const std::string path = folder.put("kept", "old");
        fs::permissions(path, fs::perms(mode));
        REQUIRE(write_file(path, bytes_of("new")));
        CHECK(int(fs::status(path).permissions()) == mode);
        CHECK(folder.get("kept") == "new");
    }
    // A new file has what the process gives to new files.
    const mode_t before = umask(027);
    REQUIRE(write_file(folder.path("fresh"), bytes_of("new")));
    umask(before);
    CHECK(int(fs::status(folder.path("fresh")).permissions()) == 0640);
}

TEST_CASE("file: extension") {
    CHECK(file_extension("a/b.c/picture.EXR") == ".exr");
    CHECK(file_extension("a.b/c") == "");
    CHECK(file_extension(".hidden") == "");
    CHECK(file_extension("x.tar.gz") == ".gz");
}
