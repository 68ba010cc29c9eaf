// SPDX-License-Identifier: Apache-2.0
// Files through calls of Windows.
// in: paths and bytes -> out: see file.h.
// docs/windows.md; docs/architecture.md, floor 0.
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cerrno>
#include <string>

#include "platform/file_calls.h"
#include "platform/path.h"
#include "platform/windows/wide.h"

namespace pileus {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 30;
constexpr DWORD kShareAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(_get_osfhandle(descriptor)); }

/// A file or a folder; closed with its owner.
struct Opened {
    HANDLE handle;

    Opened(const std::string& path, DWORD access)
        : handle(::CreateFileW(wide_path(path).c_str(), access, kShareAll, nullptr, OPEN_EXISTING,
                               FILE_FLAG_BACKUP_SEMANTICS, nullptr)) {}
    ~Opened() {
        if (is_open()) ::CloseHandle(handle);
    }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;
    bool is_open() const { return handle != INVALID_HANDLE_VALUE; }
};

DWORD facts_of(const std::string& path) { return ::GetFileAttributesW(wide_path(path).c_str()); }
bool is_there(DWORD facts) { return facts != INVALID_FILE_ATTRIBUTES; }
bool is_folder(DWORD facts) { return is_there(facts) && (facts & FILE_ATTRIBUTE_DIRECTORY) != 0; }

FileResult call_fault() {
    errno = last_errno();
    return system_fault();
}

/// Bytes from the file's place on, or from `at` where there is one.
FileResult read_piece(int descriptor, OVERLAPPED* at, void* to, std::size_t most,
                      std::size_t& got) {
    DWORD count = 0;
    const BOOL done = ::ReadFile(handle_of(descriptor), to,
                                 static_cast<DWORD>(most < kPiece ? most : kPiece), &count, at);
    got = count;
    const DWORD error = done ? ERROR_SUCCESS : ::GetLastError();
    const bool ended = error == ERROR_HANDLE_EOF || error == ERROR_BROKEN_PIPE;
    return done || ended ? FileResult{} : call_fault();
}

/// Where reading stands, which reading elsewhere moves.
struct PlaceKept {
    HANDLE file;
    LARGE_INTEGER place = {};

    explicit PlaceKept(HANDLE of) : file(of) {
        (void)::SetFilePointerEx(file, place, &place, FILE_CURRENT);
    }
    ~PlaceKept() { (void)::SetFilePointerEx(file, place, nullptr, FILE_BEGIN); }
    PlaceKept(const PlaceKept&) = delete;
    PlaceKept& operator=(const PlaceKept&) = delete;
};

/// To the folder that a path is in; true: there is none above it. The root of a drive, "C:/", keeps
/// its separator.
bool climb(std::string& path) {
    const std::size_t before = path.size();
    std::size_t length = folder_length(path);
    if (length > 1 && path[length - 1] != ':' && path[length - 2] != ':') --length;
    path.resize(length);
    return length == before || length == 0;
}

/// With '/' between names, as all that is derived from it.
void use_slashes(std::string& path) {
    for (char& c : path)
        if (c == '\\') c = '/';
}

}  // namespace

InputFile::~InputFile() {
    if (descriptor_ >= 0) _close(descriptor_);
}

FileResult InputFile::open(const char* path) {
    if (descriptor_ >= 0) _close(descriptor_);
    descriptor_ = -1;
    const HANDLE file = ::CreateFileW(wide_path(path).c_str(), GENERIC_READ, kShareAll, nullptr,
                                      OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE) {
        const FileResult fault = call_fault();
        if (is_folder(facts_of(path))) return {FileFault::kDirectory, EISDIR};
        const bool missing = fault.error == ENOENT || fault.error == ENOTDIR;
        return {missing ? FileFault::kMissing : FileFault::kSystem, fault.error};
    }
    descriptor_ = _open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_RDONLY | _O_BINARY);
    if (descriptor_ < 0) {
        ::CloseHandle(file);
        return {FileFault::kSystem, EMFILE};
    }
    LARGE_INTEGER size;
    if (::GetFileType(file) != FILE_TYPE_DISK) return {FileFault::kNotRegular, 0};
    if (!::GetFileSizeEx(file, &size)) return call_fault();
    size_ = std::uint64_t(size.QuadPart);
    return {};
}

FileResult InputFile::open_any(const char* path) {
    const FileResult result = open(path);
    return result.fault == FileFault::kNotRegular ? FileResult{} : result;
}

FileResult InputFile::read_some(void* to, std::size_t most, std::size_t& got) {
    return read_piece(descriptor_, nullptr, to, most, got);
}

FileResult InputFile::read_at(std::uint64_t at, void* to, std::size_t bytes) const {
    char* place = static_cast<char*>(to);
    const PlaceKept kept(handle_of(descriptor_));
    while (bytes > 0) {
        std::size_t got = 0;
        OVERLAPPED from = {};
        from.Offset = static_cast<DWORD>(at);
        from.OffsetHigh = static_cast<DWORD>(at >> 32);
        const FileResult result = read_piece(descriptor_, &from, place, bytes, got);
        if (!result) return result;
        if (got == 0) return {FileFault::kShort, 0};
        place += got;
        at += got;
        bytes -= got;
    }
    return {};
}

FileResult check_replaceable(const char* name) {
    std::string path;
    const FileResult followed = follow_links(name, path);
    if (!followed || is_device_path(path)) return followed;
    const DWORD facts = facts_of(path);
    if (is_folder(facts)) return {FileFault::kDirectory, EISDIR};
    if (is_there(facts) && (facts & FILE_ATTRIBUTE_READONLY) != 0)
        return {FileFault::kSystem, EACCES};

    // Climb to a folder that is there; what lies below it would be made.
    std::string folder = path;
    for (;;) {
        const bool is_top = climb(folder);
        if (folder.empty()) folder = ".";
        const DWORD found = facts_of(folder);
        if (is_folder(found)) break;
        if (is_there(found)) return {FileFault::kSystem, ENOTDIR};
        const FileResult fault = call_fault();
        if (fault.error != ENOENT || is_top) return fault;
    }
    const Opened writable(folder, FILE_ADD_FILE);
    return writable.is_open() ? FileResult{} : call_fault();
}

FileResult follow_links(const char* path, std::string& target) {
    target = path;
    if (target.compare(0, 2, "\\\\") != 0) use_slashes(target);
    const DWORD facts = facts_of(target);
    if (!is_there(facts) || (facts & FILE_ATTRIBUTE_REPARSE_POINT) == 0) return {};
    const Opened file(target, 0);
    if (!file.is_open()) return call_fault();
    std::wstring whole(512, L'\0');
    for (bool enough = false; !enough;) {
        const DWORD length = ::GetFinalPathNameByHandleW(
            file.handle, whole.data(), static_cast<DWORD>(whole.size()), FILE_NAME_NORMALIZED);
        if (length == 0) return call_fault();
        enough = length < whole.size();
        whole.resize(length);
    }
    // "\\?\C:\...": the path of a drive is as good without the mark.
    if (whole.size() > 6 && whole[5] == L':') {
        target = narrow_text(whole.substr(4));
        use_slashes(target);
    } else {
        target = narrow_text(whole);
    }
    return {};
}

FileResult identify_file(const char* path, FileIdentity& identity) {
    BY_HANDLE_FILE_INFORMATION facts;
    identity = FileIdentity();
    std::string folder = path;
    for (;;) {
        const Opened file(folder, 0);
        if (file.is_open()) {
            if (!::GetFileInformationByHandle(file.handle, &facts)) {
                // A device or a pipe; its name tells it.
                identity.name = folded_case(whole_path(path));
                return {};
            }
            break;
        }
        const FileResult fault = call_fault();
        // Climb to a folder that is there.
        if (identity.name.empty()) folder = whole_path(path);
        const std::string name = folder.substr(folder_length(folder));
        if (fault.error != ENOENT || climb(folder)) return fault;
        identity.name = folded_case(name) + '/' + identity.name;
    }
    identity.regular =
        identity.name.empty() && (facts.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
    identity.device = facts.dwVolumeSerialNumber;
    identity.inode = (std::uint64_t(facts.nFileIndexHigh) << 32) | facts.nFileIndexLow;
    return {};
}

}  // namespace pileus
