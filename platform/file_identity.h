// SPDX-License-Identifier: Apache-2.0
// Which file a path leads to, so that two names of one file are seen to be one.
// in: paths -> out: the file at the end of all links; what tells it from every other.
// stat(2), readlink(2); docs/architecture.md, floor 0.
#pragma once
#include <cstdint>
#include <string>

#include "platform/file.h"

namespace pileus {

/// What tells one file from another, whatever they are called. A file that is not there yet is told
/// by the folder in which it would be made, and its name.
struct FileIdentity {
    std::uint64_t device = 0, inode = 0;
    std::string name;      ///< below that folder; empty: the file is there
    bool regular = false;  ///< a file that is there, and no folder, device or pipe
};
inline bool operator==(const FileIdentity& a, const FileIdentity& b) {
    return a.device == b.device && a.inode == b.inode && a.name == b.name;
}

/// Follows symbolic links to the file at their end, which need not be there: `target` is a path
/// that is no link. kSystem: a ring of links, or a name that cannot be followed.
FileResult follow_links(const char* path, std::string& target);

/// Identifies the file that a path leads to, through links, or would lead to.
FileResult identify_file(const char* path, FileIdentity& identity);

}  // namespace pileus
