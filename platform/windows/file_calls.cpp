// SPDX-License-Identifier: Apache-2.0
// See file_calls.h.
#include "platform/file_calls.h"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cerrno>

#include "platform/windows/wide.h"

namespace pileus {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 30;

bool told(BOOL done) {
    if (!done) errno = last_errno();
    return done != 0;
}

std::int64_t write_piece(int descriptor, OVERLAPPED* at, const void* data, std::size_t bytes) {
    DWORD count = 0;
    const auto file = reinterpret_cast<HANDLE>(_get_osfhandle(descriptor));
    const auto most = static_cast<DWORD>(bytes < kPiece ? bytes : kPiece);
    return told(::WriteFile(file, data, most, &count, at)) ? std::int64_t(count) : -1;
}

}  // namespace

bool make_folder(const char* path) {
    return told(::CreateDirectoryW(wide_path(path).c_str(), nullptr));
}

void remove_folder(const char* path) { (void)::RemoveDirectoryW(wide_path(path).c_str()); }

void remove_file(const char* path) { (void)::DeleteFileW(wide_path(path).c_str()); }

bool move_file(const char* from, const char* to) {
    return told(::MoveFileExW(wide_path(from).c_str(), wide_path(to).c_str(),
                              MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH));
}

int create_file(const char* path) {
    const HANDLE file =
        ::CreateFileW(wide_path(path).c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_DELETE,
                      nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (!told(file != INVALID_HANDLE_VALUE)) return -1;
    const int descriptor = _open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_BINARY);
    if (descriptor < 0) ::CloseHandle(file);
    return descriptor;
}

void close_file(int descriptor) { _close(descriptor); }

std::int64_t write_some(int descriptor, const void* data, std::size_t bytes) {
    return write_piece(descriptor, nullptr, data, bytes);
}

std::int64_t write_some_at(int descriptor, std::uint64_t at, const void* data, std::size_t bytes) {
    OVERLAPPED place = {};
    place.Offset = static_cast<DWORD>(at);
    place.OffsetHigh = static_cast<DWORD>(at >> 32);
    return write_piece(descriptor, &place, data, bytes);
}

}  // namespace pileus
