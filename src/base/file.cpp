// SPDX-License-Identifier: Apache-2.0
// Whole files in and out, with one clear line per fault.
// in: paths and bytes -> out: see file.h.
// docs/scene.md lists the form of the lines.
#include "src/base/file.h"

#include <cerrno>
#include <system_error>

#include "platform/path.h"

namespace pileus {

namespace {

std::string describe(FileResult result) {
    switch (result.fault) {
        case FileFault::kMissing:
            return "no such file";
        case FileFault::kDirectory:
            return "is a folder, allowed: a file";
        case FileFault::kNotRegular:
            return "is not a regular file, allowed: a file of known length";
        case FileFault::kShort:
            return "ended before its stated length";
        default:
            return std::generic_category().message(result.error);
    }
}

/// The same fault where it is one of writing.
Status check_new_name(const std::string& path) {
    Status status = check_file_name(path);
    if (!status) status.code = Code::kIo;
    return status;
}

}  // namespace

Status check_file_name(const std::string& path) {
    if (path.empty()) return Status::bad_input("file name: empty, allowed: the path of a file");
    for (const char c : path) {
        const auto code = static_cast<unsigned char>(c);
        if (code == 0) return Status::bad_input("file name: holds a zero byte");
        if (code >= 0x20 && code != 0x7F) continue;
        return Status::bad_input("file name: holds a control character (code " +
                                 std::to_string(code) + "), \"" + printable_line(path) +
                                 "\", allowed: printable characters");
    }
    return Status::ok();
}

Status open_file(const std::string& path, InputFile& file) {
    PILEUS_TRY(check_file_name(path));
    const FileResult result = file.open(path.c_str());
    if (!result) return Status::bad_input(path + ": cannot read: " + describe(result));
    return Status::ok();
}

Status read_fault(const std::string& path, FileResult result) {
    return Status::io(path + ": reading failed half way: " + describe(result));
}

Status write_fault(const std::string& path, FileResult result) {
    const std::string line = path + ": cannot write: " + describe(result);
    return result.error == ENOMEM ? Status::limit(line) : Status::io(line);
}

Status read_whole_file(const std::string& path, std::uint64_t limit_bytes, Buffer<char>& bytes) {
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    if (file.size() > limit_bytes)
        return Status::limit(path + ": file too large, " + std::to_string(file.size()) +
                             " bytes, allowed: at most " + std::to_string(limit_bytes));
    PILEUS_TRY(bytes.resize(file.size(), path.c_str()));
    const FileResult result = file.read(bytes.data(), bytes.size());
    return result ? Status::ok() : read_fault(path, result);
}

Status read_file_start(const std::string& path, std::uint64_t most_bytes, Buffer<char>& bytes) {
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    PILEUS_TRY(bytes.resize(file.size() < most_bytes ? file.size() : most_bytes, path.c_str()));
    const FileResult result = file.read(bytes.data(), bytes.size());
    return result ? Status::ok() : read_fault(path, result);
}

Status can_write_file(const std::string& path) {
    if (path == "-")
        return Status::bad_input(
            "-: output: only a report goes to the standard output, allowed: ./- for a file of that "
            "name");
    PILEUS_TRY(check_new_name(path));
    const FileResult result = check_replaceable(path.c_str());
    return result ? Status::ok() : write_fault(path, result);
}

Status write_file(const std::string& path, Span<const char> bytes) {
    PILEUS_TRY(check_new_name(path));
    const FileResult result = replace_file(path.c_str(), bytes.data, bytes.size);
    return result ? Status::ok() : write_fault(path, result);
}

std::string file_extension(const std::string& path) {
    const std::size_t begin = folder_length(path);
    const std::size_t point = path.rfind('.');
    if (point == std::string::npos || point <= begin) return "";
    std::string extension = path.substr(point);
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return extension;
}

std::string packed_extension(const std::string& path) {
    const std::string extension = file_extension(path);
    if (extension != ".gz") return extension;
    return file_extension(path.substr(0, path.size() - extension.size()));
}

std::string numbered_path(const std::string& path, int frame) {
    const std::size_t stem = path.size() - file_extension(path).size();
    const std::string digits = std::to_string(frame);
    const std::string zeros(digits.size() < 4 ? 4 - digits.size() : 0, '0');
    return path.substr(0, stem) + "." + zeros + digits + path.substr(stem);
}

}  // namespace pileus
