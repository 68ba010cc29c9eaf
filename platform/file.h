// SPDX-License-Identifier: Apache-2.0
// Files as the machine gives them: read all of one, or replace one in a single step.
// in: paths and bytes -> out: bytes and the machine's error number; texts are made in src/base.
// docs/architecture.md, floor 0.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

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

/// All steps of a NewFile at once: `path` holds either what it held before or all of
/// the new bytes.
FileResult replace_file(const char* path, const void* data, std::size_t bytes);

/// Whether replace_file could begin: the nearest folder that is there can be written into, and
/// `path` is no folder. Changes nothing.
FileResult check_replaceable(const char* path);

// Which file a path leads to, so that two names of one file are seen to be one: stat(2),
// readlink(2); GetFileInformationByHandle.

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

// A file that nobody sees until it is whole, and that can still give way to the older one: open(2)
// O_TMPFILE, linkat(2), renameat2(2); ReplaceFileW.

/// The steps are begin, write, publish, keep; a file that was not kept is taken back by its owner,
/// the folders made for it and the older one of its name included, if the file system lets two
/// names change places. Where the machine knows files without a name (Linux O_TMPFILE), nothing is
/// left even when the process is killed while it writes; elsewhere the bytes lie under a hidden
/// name until then. Only `begin` takes memory.
class NewFile {
public:
    NewFile() = default;
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile();

    /// Makes missing parent folders. A symbolic link keeps pointing where it does, and what it
    /// points to is replaced or made; a device or a pipe is opened as it is. A new file takes owner
    /// and permissions of the one it replaces.
    FileResult begin(const char* path);
    /// All of the file's bytes, brought to the disk.
    FileResult write(const void* data, std::size_t bytes);
    /// The same in parts: bytes from byte `at` on, then all to the disk. Not for devices and pipes,
    /// which have no places.
    FileResult write_at(std::uint64_t at, const void* data, std::size_t bytes);
    FileResult flush();
    bool has_places() const { return !device_; }
    /// Gives the file its name; the older file of that name steps aside.
    FileResult publish();
    /// Lets the file outlive its owner, and drops the older one.
    void keep();

private:
    void make_folders(const std::string& path);
    void hide_beside(const std::string& path, int process);
    bool next_hidden_name(int& attempt);
    FileResult open_hidden();
    FileResult name_hidden();

    std::string target_, hidden_;
    std::string folders_;         ///< the innermost folder of the path as given
    std::size_t first_made_ = 0;  ///< length of the outermost folder that was made; 0: none
    int descriptor_ = -1;
    bool device_ = false;     ///< written at once, never renamed
    bool named_ = false;      ///< the hidden name is in the folder
    bool published_ = false;  ///< the target is the new file
    bool exchanged_ = false;  ///< the hidden name is the older file
};

}  // namespace pileus
