// SPDX-License-Identifier: Apache-2.0
// Hashes that pictures should have, as users write them down.
// in: the text of an option, or a file of lines "HASH  FILE" -> out: hashes in lower case.
// docs/program.md, "hash"
#pragma once
#include <string>
#include <vector>

#include "src/base/status.h"

namespace pileus {

/// The 16 hex digits in lower case; empty where `text` is anything else.
std::string read_hash(const std::string& text);

/// `--expect-hash`: hashes parted by commas; else kBadInput.
Status read_frame_hashes(const std::string& text, std::vector<std::string>& hashes);

/// kBadInput: not a hash for each of so many frames.
Status check_frame_hashes(const std::vector<std::string>& hashes, int frames);

/// One line of a list.
struct ListedHash {
    std::string hash, file;  ///< no file: that of the only picture
    int line = 0;            ///< from 1
};

/// Reads a list as `pileus hash` and `pileus render` print it: a hash, blanks and a name, or a hash
/// alone. Empty lines and those that begin with # do not count. kBadInput with one line for each
/// malformed line and each name that comes twice; a list without hashes; those of read_whole_file.
Status read_hash_list(const std::string& path, std::vector<ListedHash>& list);

/// The same of a text that was read from `path`.
Status parse_hash_list(const std::string& path, const std::string& text,
                       std::vector<ListedHash>& list);

/// Whether two names are one without looking at the disk: ./a.exr is a.exr.
bool same_name(const std::string& a, const std::string& b);

}  // namespace pileus
