// SPDX-License-Identifier: Apache-2.0
// Files through POSIX calls.
// in: paths and bytes -> out: see file.h.
// docs/architecture.md, floor 0.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "platform/file_calls.h"

namespace pileus {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 30;  // below every kernel's limit for one call

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

FileResult InputFile::open_any(const char* path) {
    const FileResult result = open(path);
    if (result.fault != FileFault::kNotRegular) return result;
    // Wait for the bytes of a pipe, but not for somebody to open its other end.
    const int flags = ::fcntl(descriptor_, F_GETFL);
    if (flags < 0 || ::fcntl(descriptor_, F_SETFL, flags & ~O_NONBLOCK) < 0) return system_fault();
    return {};
}

FileResult InputFile::read_some(void* to, std::size_t most, std::size_t& got) {
    ssize_t count = 0;
    do {
        count = ::read(descriptor_, to, most < kPiece ? most : kPiece);
    } while (count < 0 && errno == EINTR);
    got = count > 0 ? std::size_t(count) : 0;
    return count >= 0 ? FileResult{} : system_fault();
}

FileResult InputFile::read_at(std::uint64_t at, void* to, std::size_t bytes) const {
    char* place = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t got =
            ::pread(descriptor_, place, bytes < kPiece ? bytes : kPiece, static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_fault();
        if (got == 0) return {FileFault::kShort, 0};
        place += got;
        at += std::uint64_t(got);
        bytes -= std::size_t(got);
    }
    return {};
}

FileResult check_replaceable(const char* name) {
    struct stat facts;
    std::string path;
    const FileResult followed = follow_links(name, path);
    if (!followed) return followed;
    if (::stat(path.c_str(), &facts) == 0) {
        if (S_ISDIR(facts.st_mode)) return {FileFault::kDirectory, EISDIR};
        if (!S_ISREG(facts.st_mode))
            return ::access(path.c_str(), W_OK) == 0 ? FileResult{} : system_fault();
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

FileResult follow_links(const char* path, std::string& target) {
    constexpr int kMaxLinks = 40;  // as the kernel
    char text[4096];
    struct stat facts;
    char* resolved = ::realpath(path, nullptr);
    if (resolved == nullptr && errno == ENOMEM) return system_fault();
    target = resolved != nullptr ? resolved : path;
    std::free(resolved);
    // Some links of /proc open what their text does not name.
    if (::stat(target.c_str(), &facts) == 0) return {};
    for (int i = 0; i < kMaxLinks; ++i) {
        const ssize_t length = ::readlink(target.c_str(), text, sizeof text);
        // EINVAL: no link. What cannot be looked at shows its fault where it is opened.
        if (length < 0) return {};
        if (std::size_t(length) == sizeof text) return {FileFault::kSystem, ENAMETOOLONG};
        const std::size_t slash = text[0] == '/' ? std::string::npos : target.rfind('/');
        target.resize(slash == std::string::npos ? 0 : slash + 1);
        target.append(text, std::size_t(length));
    }
    return {FileFault::kSystem, ELOOP};
}

FileResult identify_file(const char* path, FileIdentity& identity) {
    struct stat facts;
    identity = FileIdentity();
    if (::stat(path, &facts) == 0) {
        identity.regular = S_ISREG(facts.st_mode);
    } else {
        std::string target;
        const FileResult result = follow_links(path, target);
        if (!result) return result;
        // Climb to a folder that is there. The names below it lead through no links.
        std::error_code fault;
        const auto whole = std::filesystem::weakly_canonical(target, fault);
        if (fault) return {FileFault::kSystem, fault.value()};
        std::filesystem::path folder = whole;
        do {
            if (folder == folder.parent_path()) return system_fault();
            folder = folder.parent_path();
        } while (::stat(folder.empty() ? "." : folder.c_str(), &facts) != 0);
        identity.name = whole.lexically_relative(folder).string();
    }
    identity.device = std::uint64_t(facts.st_dev);
    identity.inode = std::uint64_t(facts.st_ino);
    return {};
}

}  // namespace pileus
