// SPDX-License-Identifier: Apache-2.0
// A file that nobody sees until it is whole, and that can still give way to the older one.
// in: a path and bytes -> out: a file in its place, or the folder as it was.
// open(2) O_TMPFILE, linkat(2), renameat2(2); docs/architecture.md, floor 0.
#pragma once
#include <cstddef>
#include <string>

#include "platform/file.h"

namespace pileus {

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
    /// Gives the file its name; the older file of that name steps aside.
    FileResult publish();
    /// Lets the file outlive its owner, and drops the older one.
    void keep();

private:
    void make_folders(const std::string& path);
    FileResult open_hidden();
    FileResult name_hidden();
    void next_hidden_name(int attempt);

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
