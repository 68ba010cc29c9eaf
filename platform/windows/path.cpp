// SPDX-License-Identifier: Apache-2.0
// See path.h.
#include "platform/path.h"

#include <windows.h>

#include "platform/fs_path.h"
#include "platform/windows/wide.h"

namespace pileus {

bool is_absolute_path(const std::string& path) {
    const bool drive = path.size() > 2 && path[1] == ':' &&
                       ((path[0] >= 'A' && path[0] <= 'Z') || (path[0] >= 'a' && path[0] <= 'z'));
    const char first = path.empty() ? '.' : path[drive ? 2 : 0];
    return first == '/' || first == '\\';
}

std::size_t folder_length(const std::string& path) { return path.find_last_of("/\\:") + 1; }

std::string environment_text(const char* name) {
    std::wstring value(128, L'\0');
    for (;;) {
        const DWORD got = ::GetEnvironmentVariableW(wide_text(name).c_str(), value.data(),
                                                    static_cast<DWORD>(value.size()));
        const bool whole = got < value.size();
        value.resize(got);
        if (whole) return narrow_text(value);
    }
}

std::filesystem::path path_of(const std::string& text) { return wide_text(text); }
std::string path_text(const std::filesystem::path& path) {
    return narrow_text(path.generic_wstring());
}

}  // namespace pileus
