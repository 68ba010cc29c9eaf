// SPDX-License-Identifier: Apache-2.0
// What files have in common on all systems.
// in: paths and bytes -> out: see file.h.
#include "platform/file.h"

#include <cerrno>

#include "platform/file_calls.h"

namespace pileus {

FileResult system_fault() { return {FileFault::kSystem, errno}; }

FileResult InputFile::read(void* to, std::size_t bytes) {
    char* at = static_cast<char*>(to);
    while (bytes > 0) {
        std::size_t got = 0;
        const FileResult result = read_some(at, bytes, got);
        if (!result) return result;
        if (got == 0) return {FileFault::kShort, 0};
        at += got;
        bytes -= got;
    }
    return {};
}

FileResult replace_file(const char* path, const void* data, std::size_t bytes) {
    NewFile file;
    FileResult result = file.begin(path);
    if (result) result = file.write(data, bytes);
    if (result) result = file.publish();
    if (result) file.keep();
    return result;
}

}  // namespace pileus
