// SPDX-License-Identifier: Apache-2.0
// What tests of pictures in place of scenes share.
// in: a folder, a command line -> out: checks that it is refused with one line.
// docs/program.md, "A picture made again"
#pragma once
#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"

namespace pileus {
namespace test {

/// Pictures hold scenes in EXR files alone.
inline bool skips_pictures() {
    const bool none = !can_write_image("a.exr");
    if (none) MESSAGE("skipped: no OpenEXR in this build");
    return none;
}

/// One line, exit 2, no new file.
inline void check_refused(const ProgramFolder& folder, const std::string& arguments,
                          const std::string& said) {
    CAPTURE(arguments);
    const std::vector<std::string> before = folder.left();
    const Outcome outcome = folder.run(arguments);
    CHECK(outcome.exit_status == 2);
    CHECK(outcome.output == "");
    CHECK_MESSAGE(line_count(outcome.errors) == 1, outcome.errors);
    CHECK_MESSAGE(holds(outcome.errors, said), outcome.errors);
    CHECK(folder.left() == before);
}

}  // namespace test
}  // namespace pileus
