// SPDX-License-Identifier: Apache-2.0
// See output_check.h.
// in: names of files -> out: clashes.
// docs/program.md, "What is never overwritten"
#include "tools/study/output_check.h"

#include "platform/file.h"

namespace pileus {

void OutputCheck::reads(const std::string& path, const std::string& what) {
    FileIdentity file;
    if (!identify_file(path.c_str(), file) || !file.regular) return;
    names_.emplace(Key{file.device, file.inode, file.name}, Name{path, what});
}

Status OutputCheck::writes(const std::string& path) {
    FileIdentity file;
    // A name that leads nowhere shows its fault where it is opened.
    if (!identify_file(path.c_str(), file)) return Status::ok();
    if (file.name.empty() && !file.regular) return Status::ok();
    const auto [place, fresh] =
        names_.emplace(Key{file.device, file.inode, file.name}, Name{path, ""});
    if (fresh) return Status::ok();
    const Name& other = place->second;
    const bool same = other.path == path;
    if (other.what.empty())
        return Status::bad_input(
            path + ": output: " +
            (same ? "named twice, allowed: once"
                  : "is the same file as " + other.path + ", allowed: another file"));
    return Status::bad_input(path + ": output: is " + other.what + (same ? "" : ", " + other.path) +
                             ", allowed: another file");
}

}  // namespace pileus
