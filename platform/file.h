// SPDX-License-Identifier: Apache-2.0
// Files as the machine gives them: read all of one, or replace one in a single step.
// in: paths and bytes -> out: bytes and the machine's error number; texts are made in src/base.
// docs/architecture.md, floor 0.
#pragma once
#include <cstddef>
#include <cstdint>

namespace pileus {

enum class FileFault {
    kNone,
    kMissing,     ///< no such file
    kDirectory,   ///< a folder where a file is needed
    kNotRegular,  ///< a device or a pipe where a file of known length is needed
    kShort,       ///< the file ended before its stated length
    kSystem       ///< anything else; `error` says what
};

/// `error` is errno's value at the fault, 0 where there is none.
struct [[nodiscard]] FileResult {
    FileFault fault = FileFault::kNone;
    int error = 0;
    explicit operator bool() const { return fault == FileFault::kNone; }
};

/// A regular file opened for reading from its start; closed with its owner.
class InputFile {
public:
    InputFile() = default;
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    FileResult open(const char* path);
    /// The same, but a pipe or a device will do as well; its size() is 0.
    FileResult open_any(const char* path);
    /// Length in bytes when it was opened.
    std::uint64_t size() const { return size_; }
    /// Reads exactly `bytes`; kShort when the file ends before.
    FileResult read(void* to, std::size_t bytes);
    /// Reads up to `most` bytes; none only at the end.
    FileResult read_some(void* to, std::size_t most, std::size_t& got);
    /// Reads exactly `bytes` from byte `at` on, wherever reading stands; kShort as above.
    FileResult read_at(std::uint64_t at, void* to, std::size_t bytes) const;

private:
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// All steps of a NewFile (new_file.h) at once: `path` holds either what it held before or all of
/// the new bytes.
FileResult replace_file(const char* path, const void* data, std::size_t bytes);

/// Whether replace_file could begin: the nearest folder that is there can be written into, and
/// `path` is no folder. Changes nothing.
FileResult check_replaceable(const char* path);

}  // namespace pileus
