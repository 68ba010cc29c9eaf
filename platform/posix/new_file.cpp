// SPDX-License-Identifier: Apache-2.0
// Steps of new files through POSIX and Linux calls.
// in: paths and bytes -> out: see file.h.
// open(2) O_TMPFILE, linkat(2), renameat2(2); docs/architecture.md, floor 0.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "platform/file_calls.h"
#include "platform/path.h"

namespace pileus {

namespace {

/// A file without a name in that folder; -1 where the machine or its file system has none.
int open_unnamed(const std::string& folder) {
#ifdef O_TMPFILE
    // Its name is given through /proc, which may be missing.
    if (::access("/proc/self/fd", X_OK) != 0) return -1;
    return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
#else
    (void)folder;
    return -1;
#endif
}

/// Lets two names change places; errno is EINVAL where nobody knows how to.
bool exchange(const char* a, const char* b) {
#ifdef RENAME_EXCHANGE
    return ::renameat2(AT_FDCWD, a, AT_FDCWD, b, RENAME_EXCHANGE) == 0;
#else
    (void)a, (void)b;
    errno = EINVAL;
    return false;
#endif
}

/// Gives a file without bytes the owner and the permissions of the one that it will replace. A
/// file system without them, or an owner that is not ours to give, is no fault.
void keep_owner(int descriptor, const struct stat& older) {
    struct stat now;
    if (::fstat(descriptor, &now) != 0) return;
    if (now.st_uid != older.st_uid || now.st_gid != older.st_gid)
        (void)!::fchown(descriptor, older.st_uid, older.st_gid);
    (void)!::fchmod(descriptor, older.st_mode & 0777);
}

}  // namespace

FileResult NewFile::begin(const char* path) {
    // Replace what a link leads to, so that the link itself survives the renaming.
    FileResult result = follow_links(path, target_);
    if (!result) return result;
    make_folders(target_);
    struct stat facts;
    // Never rename over something that is not a plain file: that would destroy a device node.
    const bool older = ::stat(target_.c_str(), &facts) == 0;
    if (older && S_ISDIR(facts.st_mode)) return {FileFault::kDirectory, EISDIR};
    device_ = older && !S_ISREG(facts.st_mode);
    if (device_) {
        descriptor_ = ::open(path, O_WRONLY | O_CLOEXEC);
        return descriptor_ >= 0 ? FileResult{} : system_fault();
    }
    hide_beside(target_, int(::getpid()));
    descriptor_ = open_unnamed(hidden_.substr(0, folder_length(hidden_)));
    if (descriptor_ < 0) result = open_hidden();
    if (result && older) keep_owner(descriptor_, facts);
    return result;
}

/// Gives a file without a name its hidden one.
FileResult NewFile::name_hidden() {
    char from[40];
    std::snprintf(from, sizeof from, "/proc/self/fd/%d", descriptor_);
    for (int attempt = 0; !named_ && next_hidden_name(attempt);) {
        const int done = ::linkat(AT_FDCWD, from, AT_FDCWD, hidden_.c_str(), AT_SYMLINK_FOLLOW);
        named_ = done == 0;
        if (!named_ && errno != EEXIST) break;
    }
    return named_ ? FileResult{} : system_fault();
}

FileResult NewFile::flush() {
    // Bring the bytes to the disk before the name, so that a power cut leaves no half file.
    if (!device_ && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
        return system_fault();
    return {};
}

FileResult NewFile::publish() {
    FileResult result;
    if (!device_ && !named_) result = name_hidden();
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0 && result) result = system_fault();
    if (!result || device_) return result;
    // Without an older file, or where names cannot change places, the new one simply takes its
    // name.
    exchanged_ = exchange(hidden_.c_str(), target_.c_str());
    const bool plain = errno == ENOENT || errno == EINVAL || errno == ENOSYS || errno == ENOTSUP;
    if (!exchanged_ && (!plain || ::rename(hidden_.c_str(), target_.c_str()) != 0))
        return system_fault();
    published_ = true;
    return {};
}

}  // namespace pileus
