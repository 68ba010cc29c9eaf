// SPDX-License-Identifier: Apache-2.0
// Steps of new files through calls of Windows.
// in: paths and bytes -> out: see file.h.
// ReplaceFileW; docs/windows.md
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cerrno>

#include "platform/file_calls.h"
#include "platform/windows/wide.h"

namespace pileus {

FileResult NewFile::begin(const char* path) {
    const FileResult result = follow_links(path, target_);
    if (!result) return result;
    device_ = is_device_path(target_);
    if (device_) {
        descriptor_ = _wopen(wide_path(target_).c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
        return descriptor_ >= 0 ? FileResult{} : system_fault();
    }
    make_folders(target_);
    const DWORD facts = ::GetFileAttributesW(wide_path(target_).c_str());
    if (facts != INVALID_FILE_ATTRIBUTES && (facts & FILE_ATTRIBUTE_DIRECTORY) != 0)
        return {FileFault::kDirectory, EISDIR};
    hide_beside(target_, int(::GetCurrentProcessId()));
    return open_hidden();
}

FileResult NewFile::flush() {
    const auto file = reinterpret_cast<HANDLE>(_get_osfhandle(descriptor_));
    if (device_ || ::FlushFileBuffers(file)) return {};
    errno = last_errno();
    return system_fault();
}

FileResult NewFile::publish() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (_close(descriptor) != 0) return system_fault();
    if (device_) return {};
    // The older file keeps a hidden name until `keep`; the new one takes its permissions.
    const std::string older = hidden_.substr(0, hidden_.size() - 3) + "old";
    const std::wstring from = wide_path(hidden_), to = wide_path(target_), aside = wide_path(older);
    constexpr DWORD kHow = REPLACEFILE_IGNORE_MERGE_ERRORS | REPLACEFILE_IGNORE_ACL_ERRORS;
    exchanged_ =
        ::ReplaceFileW(to.c_str(), from.c_str(), aside.c_str(), kHow, nullptr, nullptr) != 0;
    if (!exchanged_) {
        // There was none, or a file system without the step; it may have gone half of the way.
        exchanged_ = ::GetLastError() == ERROR_UNABLE_TO_MOVE_REPLACEMENT_2;
        if (!move_file(hidden_.c_str(), target_.c_str())) {
            const FileResult fault = system_fault();
            if (exchanged_) (void)move_file(older.c_str(), target_.c_str());
            exchanged_ = false;
            return fault;
        }
    }
    if (exchanged_) hidden_ = older;
    published_ = true;
    return {};
}

}  // namespace pileus
