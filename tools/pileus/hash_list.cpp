// SPDX-License-Identifier: Apache-2.0
// See hash_list.h. Nothing in a list is trusted: each line is a hash and a name, or a fault.
// in: text -> out: hashes.
// docs/program.md, "hash"
#include "tools/pileus/hash_list.h"

#include <filesystem>
#include <map>

#include "platform/fs_path.h"
#include "src/base/file.h"
#include "src/base/printable.h"
#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/option_text.h"

namespace pileus {

namespace {

constexpr std::size_t kDigits = 16;
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 24;
/// Malformed lines that are told: a file that is no list has little else.
constexpr int kMaxFaults = 10;

std::string plain_name(const std::string& name) {
    return path_text(path_of(name).lexically_normal());
}

/// Text without what ends a line in files of other systems.
std::string without_end(std::string text) {
    while (!text.empty() && (text.back() == '\r' || text.back() == ' ' || text.back() == '\t'))
        text.pop_back();
    return text;
}

Status read_line(const std::string& text, ListedHash& entry) {
    const std::size_t end = text.find_first_of(" \t");
    entry.hash = read_hash(text.substr(0, end));
    if (entry.hash.empty())
        return Status::bad_input("no hash, " + quote_text(text) +
                                 ", allowed: 16 hex digits, blanks and the name of a picture");
    if (end == std::string::npos) return Status::ok();
    entry.file = text.substr(text.find_first_not_of(" \t", end));
    return check_file_name(entry.file);
}

/// Names that come twice; a list of several may have no line without a name.
Status check_list(const std::string& path, const std::vector<ListedHash>& list) {
    Status faults;
    std::map<std::string, int> lines;
    for (const ListedHash& entry : list) {
        const std::string where = path + ":" + std::to_string(entry.line) + ": ";
        if (entry.file.empty() && list.size() > 1)
            add_fault(Status::bad_input(where + "no name, " + entry.hash +
                                        ", allowed: a name behind each hash, or one line"),
                      faults);
        if (entry.file.empty()) continue;
        const auto [known, added] = lines.emplace(plain_name(entry.file), entry.line);
        if (!added)
            add_fault(
                Status::bad_input(where + "given twice, " + quote_text(entry.file) +
                                  ", allowed: once, as in line " + std::to_string(known->second)),
                faults);
    }
    return faults;
}

}  // namespace

std::string read_hash(const std::string& text) {
    if (text.size() != kDigits) return "";
    std::string hash = text;
    for (char& c : hash) {
        if (c >= 'A' && c <= 'F') c = char(c - 'A' + 'a');
        if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'))) return "";
    }
    return hash;
}

Status read_frame_hashes(const std::string& text, std::vector<std::string>& hashes) {
    hashes.clear();
    for (std::size_t at = 0; at != std::string::npos;) {
        const std::size_t comma = text.find(',', at);
        const std::string part = text.substr(at, comma - at);
        hashes.push_back(read_hash(part));
        if (hashes.back().empty())
            return Status::bad_input("--expect-hash: no hash, " + quote_text(part) +
                                     ", allowed: 16 hex digits, for several frames a hash each, "
                                     "parted by commas");
        at = comma == std::string::npos ? comma : comma + 1;
    }
    return Status::ok();
}

Status check_frame_hashes(const std::vector<std::string>& hashes, int frames) {
    if (hashes.size() == std::size_t(frames)) return Status::ok();
    return Status::bad_input(
        "--expect-hash: hashes: wrong number, " + std::to_string(hashes.size()) +
        ", allowed: " + std::to_string(frames) + ", one for each frame, parted by commas");
}

Status read_hash_list(const std::string& path, std::vector<ListedHash>& list) {
    Buffer<char> bytes;
    PILEUS_TRY(check_file_name(path));
    PILEUS_TRY(read_whole_file(path, kMaxBytes, bytes));
    const Span<const char> text = without_mark(bytes.span());
    return parse_hash_list(path, std::string(text.data, text.size), list);
}

Status parse_hash_list(const std::string& path, const std::string& text,
                       std::vector<ListedHash>& list) {
    Status faults;
    int number = 0, malformed = 0;
    for (std::size_t at = 0; at < text.size() && malformed < kMaxFaults;) {
        const std::size_t end = text.find('\n', at);
        const std::string line = without_end(text.substr(at, end - at));
        at = end == std::string::npos ? text.size() : end + 1;
        ++number;
        if (line.empty() || line[0] == '#') continue;
        list.emplace_back();
        list.back().line = number;
        Status status = read_line(line, list.back());
        if (!status) {
            status.message = path + ":" + std::to_string(number) + ": " + status.message;
            ++malformed;
        }
        add_fault(status, faults);
    }
    PILEUS_TRY(faults);
    if (list.empty())
        return Status::bad_input(path +
                                 ": no hashes, allowed: lines of 16 hex digits, blanks and "
                                 "the name of a picture");
    return check_list(path, list);
}

bool same_name(const std::string& a, const std::string& b) {
    return plain_name(a) == plain_name(b);
}

}  // namespace pileus
