// SPDX-License-Identifier: Apache-2.0
// See wide.h.
#include "platform/windows/wide.h"

#include <windows.h>

#include <cerrno>

namespace pileus {

std::wstring wide_text(std::string_view text) {
    const int bytes = int(text.size());
    std::wstring wide(text.size(), L'\0');  // never has more units than bytes
    const int units =
        bytes > 0 ? ::MultiByteToWideChar(CP_UTF8, 0, text.data(), bytes, wide.data(), bytes) : 0;
    wide.resize(std::size_t(units));
    return wide;
}

std::string narrow_text(std::wstring_view text) {
    const int units = int(text.size());
    const auto convert = [&](char* to, int room) {
        if (units == 0) return 0;
        return ::WideCharToMultiByte(CP_UTF8, 0, text.data(), units, to, room, nullptr, nullptr);
    };
    std::string narrow(std::size_t(convert(nullptr, 0)), '\0');
    (void)convert(narrow.data(), int(narrow.size()));
    return narrow;
}

namespace {

/// The text itself where Windows knows no such path.
std::wstring whole_text(const std::wstring& wide) {
    std::wstring whole(512, L'\0');
    for (bool enough = false; !enough;) {
        const DWORD length = ::GetFullPathNameW(wide.c_str(), static_cast<DWORD>(whole.size()),
                                                whole.data(), nullptr);
        if (length == 0) return wide;
        enough = length < whole.size();
        whole.resize(length);
    }
    return whole;
}

}  // namespace

std::string whole_path(const std::string& path) { return narrow_text(whole_text(wide_text(path))); }

bool is_device_path(const std::string& path) {
    return whole_text(wide_text(path)).compare(0, 4, L"\\\\.\\") == 0;
}

std::string folded_case(const std::string& text) {
    std::wstring wide = wide_text(text);
    std::wstring lower(wide.size(), L'\0');
    const int units = ::LCMapStringW(LOCALE_INVARIANT, LCMAP_LOWERCASE, wide.data(),
                                     int(wide.size()), lower.data(), int(lower.size()));
    return units > 0 ? narrow_text(lower) : text;
}

std::wstring wide_path(const std::string& path) {
    constexpr std::size_t kLong = 240;  // below any limit, with room for a hidden name
    const std::wstring wide = wide_text(path);
    const std::wstring whole = whole_text(wide);
    if (whole.size() < kLong || whole.compare(0, 4, L"\\\\?\\") == 0) return wide;
    if (whole.compare(0, 2, L"\\\\") == 0) return L"\\\\?\\UNC" + whole.substr(1);
    return L"\\\\?\\" + whole;
}

int last_errno() {
    switch (::GetLastError()) {
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
        case ERROR_INVALID_NAME:
        case ERROR_INVALID_DRIVE:
        case ERROR_BAD_PATHNAME:
        case ERROR_BAD_NETPATH:
        case ERROR_BAD_NET_NAME:
            return ENOENT;
        case ERROR_ACCESS_DENIED:
        case ERROR_SHARING_VIOLATION:
        case ERROR_LOCK_VIOLATION:
        case ERROR_CURRENT_DIRECTORY:
            return EACCES;
        case ERROR_WRITE_PROTECT:
            return EROFS;
        case ERROR_FILE_EXISTS:
        case ERROR_ALREADY_EXISTS:
            return EEXIST;
        case ERROR_DIRECTORY:
            return ENOTDIR;
        case ERROR_NOT_ENOUGH_MEMORY:
        case ERROR_OUTOFMEMORY:
            return ENOMEM;
        case ERROR_DISK_FULL:
        case ERROR_HANDLE_DISK_FULL:
            return ENOSPC;
        case ERROR_TOO_MANY_OPEN_FILES:
            return EMFILE;
        case ERROR_FILENAME_EXCED_RANGE:
            return ENAMETOOLONG;
        case ERROR_BROKEN_PIPE:
        case ERROR_NO_DATA:
            return EPIPE;
        case ERROR_NOT_SUPPORTED:
        case ERROR_INVALID_FUNCTION:
            return ENOSYS;
        case ERROR_CANT_RESOLVE_FILENAME:
            return ELOOP;
        case ERROR_BAD_EXE_FORMAT:
            return ENOEXEC;
        default:
            return EIO;
    }
}

}  // namespace pileus
