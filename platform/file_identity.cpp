// SPDX-License-Identifier: Apache-2.0
// Links and identities through POSIX calls.
// in: paths -> out: see file_identity.h.
// stat(2), readlink(2), realpath(3); docs/architecture.md, floor 0.
#include "platform/file_identity.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace pileus {

namespace {

FileResult system_fault() { return {FileFault::kSystem, errno}; }

}  // namespace

FileResult follow_links(const char* path, std::string& target) {
    constexpr int kMostLinks = 40;  // as the kernel
    char text[4096];
    struct stat facts;
    char* resolved = ::realpath(path, nullptr);
    if (resolved == nullptr && errno == ENOMEM) return system_fault();
    target = resolved != nullptr ? resolved : path;
    std::free(resolved);
    // Some links of /proc open what their text does not name.
    if (::stat(target.c_str(), &facts) == 0) return {};
    for (int i = 0; i < kMostLinks; ++i) {
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
