// SPDX-License-Identifier: Apache-2.0
// Files through POSIX calls.
// in: paths and bytes -> out: see file.h.
// docs/architecture.md, floor 0.
#include "platform/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace pileus {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 30;  // below every kernel's limit for one call

FileResult system_fault() { return {FileFault::kSystem, errno}; }

FileResult write_all(int descriptor, const char* data, std::size_t bytes) {
    while (bytes > 0) {
        const ssize_t written = ::write(descriptor, data, bytes < kPiece ? bytes : kPiece);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return system_fault();
        data += written;
        bytes -= std::size_t(written);
    }
    return {};
}

/// A failure to make a folder shows when the file in it is opened.
void make_parent_folders(const std::string& path) {
    for (std::size_t at = path.find('/', 1); at != std::string::npos; at = path.find('/', at + 1))
        (void)!::mkdir(path.substr(0, at).c_str(), 0777);
}

/// Follows links to an existing file, so that the link itself survives the renaming.
std::string final_path(const char* path) {
    char* resolved = ::realpath(path, nullptr);
    std::string text = resolved != nullptr ? resolved : path;
    std::free(resolved);
    return text;
}

int open_temporary(const std::string& target, std::string& name) {
    constexpr int kAttempts = 100;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        name = target + '.' + std::to_string(::getpid()) + '-' + std::to_string(attempt) + ".tmp";
        const int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
        const int descriptor = ::open(name.c_str(), flags, 0666);
        if (descriptor >= 0 || errno != EEXIST) return descriptor;
    }
    return -1;
}

FileResult write_device(const char* path, const char* data, std::size_t bytes) {
    const int descriptor = ::open(path, O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return system_fault();
    FileResult result = write_all(descriptor, data, bytes);
    if (::close(descriptor) != 0 && result) result = system_fault();
    return result;
}

}  // namespace

InputFile::~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

FileResult InputFile::open(const char* path) {
    if (descriptor_ >= 0) ::close(descriptor_);
    // Do not wait for the other end should the path be a pipe.
    descriptor_ = ::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) {
        const bool missing = errno == ENOENT || errno == ENOTDIR;
        return {missing ? FileFault::kMissing : FileFault::kSystem, errno};
    }
    struct stat facts;
    if (::fstat(descriptor_, &facts) != 0) return system_fault();
    if (S_ISDIR(facts.st_mode)) return {FileFault::kDirectory, EISDIR};
    if (!S_ISREG(facts.st_mode)) return {FileFault::kNotRegular, 0};
    size_ = std::uint64_t(facts.st_size);
    return {};
}

FileResult InputFile::read(void* to, std::size_t bytes) {
    char* at = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t got = ::read(descriptor_, at, bytes < kPiece ? bytes : kPiece);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_fault();
        if (got == 0) return {FileFault::kShort, 0};
        at += got;
        bytes -= std::size_t(got);
    }
    return {};
}

FileResult replace_file(const char* path, const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    make_parent_folders(path);

    // Never rename over something that is not a plain file: that would destroy a device node.
    struct stat facts;
    if (::stat(path, &facts) == 0) {
        if (S_ISDIR(facts.st_mode)) return {FileFault::kDirectory, EISDIR};
        if (!S_ISREG(facts.st_mode)) return write_device(path, from, bytes);
    }

    // Bring the bytes to the disk before the name, so that a power cut leaves no half file.
    const std::string target = final_path(path);
    std::string temporary;
    const int descriptor = open_temporary(target, temporary);
    if (descriptor < 0) return system_fault();
    FileResult result = write_all(descriptor, from, bytes);
    if (result && ::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP)
        result = system_fault();
    if (::close(descriptor) != 0 && result) result = system_fault();
    if (result && ::rename(temporary.c_str(), target.c_str()) != 0) result = system_fault();
    if (!result) ::unlink(temporary.c_str());
    return result;
}

FileResult check_replaceable(const char* path) {
    struct stat facts;
    if (::stat(path, &facts) == 0) {
        if (S_ISDIR(facts.st_mode)) return {FileFault::kDirectory, EISDIR};
        if (!S_ISREG(facts.st_mode))
            return ::access(path, W_OK) == 0 ? FileResult{} : system_fault();
    }

    // Climb to a folder that is there; what lies below it would be made.
    std::string folder = path;
    for (;;) {
        const std::size_t slash = folder.rfind('/');
        if (slash == std::string::npos)
            folder = ".";
        else
            folder.resize(slash > 0 ? slash : 1);
        if (::stat(folder.c_str(), &facts) == 0) break;
        if (errno != ENOENT || folder == "." || folder == "/") return system_fault();
    }
    if (!S_ISDIR(facts.st_mode)) return {FileFault::kSystem, ENOTDIR};
    return ::access(folder.c_str(), W_OK | X_OK) == 0 ? FileResult{} : system_fault();
}

}  // namespace pileus
