// SPDX-License-Identifier: Apache-2.0
// Whole files in and out, with one clear line per fault.
// in: a path -> out: its bytes; in: bytes -> out: a file that is complete or not there.
// docs/scene.md lists the form of the lines.
#pragma once
#include <cstdint>
#include <string>

#include "platform/file.h"
#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// Refuses the name of a file that is empty or holds a control character, a line feed for one:
/// every message is one line. kBadInput.
Status check_file_name(const std::string& path);

/// Opens a regular file. Missing, a folder, a device or not permitted: kBadInput.
Status open_file(const std::string& path, InputFile& file);

/// The line for a fault met while reading: kIo.
Status read_fault(const std::string& path, FileResult result);

/// The line for a fault met while writing: kIo, or kLimit where it is a lack of memory.
Status write_fault(const std::string& path, FileResult result);

/// Reads all of a file. Faults of open_file; longer than `limit_bytes` or than memory: kLimit;
/// a failure half way: kIo.
Status read_whole_file(const std::string& path, std::uint64_t limit_bytes, Buffer<char>& bytes);

/// Reads the first `most_bytes` of a file, or all of a shorter one. Faults as read_whole_file's.
Status read_file_start(const std::string& path, std::uint64_t most_bytes, Buffer<char>& bytes);

/// Replaces or makes `path` in one step, missing parent folders included; any fault: kIo, and no
/// new or partial file is left.
Status write_file(const std::string& path, Span<const char> bytes);

/// Tells before the work is done whether write_file could begin; its fault if not.
Status can_write_file(const std::string& path);

/// What follows the last point of the file's name, in lower case (ASCII), the point included;
/// empty where there is none.
std::string file_extension(const std::string& path);
/// The row of a table of formats whose `extension` a path has; null: none.
template <class Row, std::size_t N>
const Row* row_of_extension(const Row (&rows)[N], const std::string& path) {
    const std::string extension = file_extension(path);
    for (const Row& row : rows)
        if (extension == row.extension) return &row;
    return nullptr;
}
/// The extensions of those rows that `use` takes, for messages.
template <class Row, std::size_t N, class Use>
std::string extensions_of(const Row (&rows)[N], const char* between, Use use) {
    std::string list;
    for (const Row& row : rows)
        if (use(row)) list += (list.empty() ? "" : between) + std::string(row.extension);
    return list;
}
/// The same of what a name that ends in ".gz" says is packed there.
std::string packed_extension(const std::string& path);

/// "out/name.png" of frame 7 becomes "out/name.0007.png".
std::string numbered_path(const std::string& path, int frame);

}  // namespace pileus
