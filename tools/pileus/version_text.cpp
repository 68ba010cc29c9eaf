// SPDX-License-Identifier: Apache-2.0
// See version_text.h. The one file that is compiled again after a commit.
#include "tools/pileus/version_text.h"

#include "src/base/printable.h"
#include "src/session/render.h"
#include "tools/pileus/commit.h"

namespace pileus {

const char* commit_text() { return PILEUS_COMMIT_TEXT; }

std::string version_text() { return version_text(kVersion, commit_text()); }

std::string version_text(const std::string& version, const std::string& commit) {
    const std::string known = commit.empty() ? version : version + " (" + commit + ")";
    return printable_line(known);
}

}  // namespace pileus
