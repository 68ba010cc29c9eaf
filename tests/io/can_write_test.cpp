// SPDX-License-Identifier: Apache-2.0
// Asking beforehand whether a file could be written: the same answer, and nothing changed.
// in: a fresh folder -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>
#include <unistd.h>

#include "src/base/file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

TEST_CASE("file: can_write_file agrees with write_file and changes nothing") {
    const test::TempFolder folder;
    const std::string file = folder.put("file", "as it was");
    for (const char* name : {"file", "new", "x/y/z", "/x//y", "./x"}) {
        CAPTURE(name);
        CHECK(can_write_file(folder.path(name)));
    }
    CHECK(can_write_file("in-the-working-directory"));
    CHECK(can_write_file("/dev/null"));
    for (const std::string& path : {folder.path(""), folder.path("file/x"), folder.path("file/x/y"),
                                    std::string(), std::string("a\0b", 3)}) {
        CAPTURE(path);
        const Status asked = can_write_file(path), done = write_file(path, {"", 0});
        CHECK(asked.code == Code::kIo);
        CHECK(done.code == Code::kIo);
    }
    CHECK(folder.entries() == 1);
    CHECK(folder.get("file") == "as it was");
}

TEST_CASE("file: can_write_file sees missing permission") {
    if (geteuid() == 0) {
        MESSAGE("skipped: permissions do not bind this user");
        return;
    }
    const test::TempFolder folder;
    std::filesystem::create_directory(folder.path("closed"));
    std::filesystem::permissions(folder.path("closed"), std::filesystem::perms::owner_read);
    CHECK(can_write_file(folder.path("closed/x")).code == Code::kIo);
    CHECK(can_write_file(folder.path("closed/x/y")).code == Code::kIo);
}
