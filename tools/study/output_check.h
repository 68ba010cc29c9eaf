// SPDX-License-Identifier: Apache-2.0
// Keeps a run from writing over what it reads, and from writing one file twice.
// in: names of files that are read and written -> out: kBadInput with one line for each clash.
// docs/program.md, "What is never overwritten"
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "src/base/status.h"

namespace pileus {

/// Files are told by device and inode, so a link of either kind is the file that it leads to.
/// Devices and pipes clash with nothing.
class OutputCheck {
public:
    /// A file that the run reads; `what` it is, as in "is the scene itself". One that is not there
    /// is left to its reader.
    void reads(const std::string& path, const std::string& what);

    /// kBadInput: `path` is a file that is read, or one that was given here before.
    Status writes(const std::string& path);

private:
    using Key = std::tuple<std::uint64_t, std::uint64_t, std::string>;
    struct Name {
        std::string path, what;  ///< `what` is empty for an output
    };
    std::map<Key, Name> names_;
};

}  // namespace pileus
