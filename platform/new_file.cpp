// SPDX-License-Identifier: Apache-2.0
// What new files have in common on all systems: folders, hidden names, bytes, and taking all back.
// in: paths and bytes -> out: see file.h.
// docs/architecture.md, floor 0.
#include <cerrno>

#include "platform/file_calls.h"
#include "platform/path.h"

namespace pileus {

namespace {
constexpr int kAttempts = 100;
}

NewFile::~NewFile() {
    if (descriptor_ >= 0) close_file(descriptor_);
    if (published_ && exchanged_) (void)move_file(hidden_.c_str(), target_.c_str());
    if (published_ && !exchanged_) remove_file(target_.c_str());
    if (!published_ && named_) remove_file(hidden_.c_str());

    // Take back the folders that were made, the innermost first; one in use stays.
    while (first_made_ > 0 && folders_.size() >= first_made_) {
        remove_folder(folders_.c_str());
        const std::size_t length = folder_length(folders_);
        folders_.resize(length > 0 ? length - 1 : 0);
    }
}

/// A failure to make a folder shows when the file in it is opened.
void NewFile::make_folders(const std::string& path) {
    for (std::size_t at = path.find('/', 1); at != std::string::npos; at = path.find('/', at + 1)) {
        folders_ = path.substr(0, at);
        if (make_folder(folders_.c_str()) && first_made_ == 0) first_made_ = at;
    }
}

void NewFile::hide_beside(const std::string& path, int process) {
    const std::size_t length = folder_length(path);
    hidden_ = length > 0 ? path.substr(0, length) : "./";
    hidden_ += ".pileus-" + std::to_string(process) + "-00.tmp";
}

/// Changes the last characters of the hidden name in place.
bool NewFile::next_hidden_name(int& attempt) {
    if (attempt >= kAttempts) return false;
    hidden_[hidden_.size() - 6] = char('0' + attempt / 10);
    hidden_[hidden_.size() - 5] = char('0' + attempt % 10);
    ++attempt;
    return true;
}

FileResult NewFile::open_hidden() {
    for (int attempt = 0; !named_ && next_hidden_name(attempt);) {
        descriptor_ = create_file(hidden_.c_str());
        named_ = descriptor_ >= 0;
        if (!named_ && errno != EEXIST) break;
    }
    return named_ ? FileResult{} : system_fault();
}

FileResult NewFile::write(const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const std::int64_t done = write_some(descriptor_, from, bytes);
        if (done < 0) return system_fault();
        from += done;
        bytes -= std::size_t(done);
    }
    return flush();
}

FileResult NewFile::write_at(std::uint64_t at, const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const std::int64_t done = write_some_at(descriptor_, at, from, bytes);
        if (done <= 0) return system_fault();
        from += done;
        at += std::uint64_t(done);
        bytes -= std::size_t(done);
    }
    return {};
}

void NewFile::keep() {
    if (exchanged_) remove_file(hidden_.c_str());
    published_ = exchanged_ = named_ = false;
    first_made_ = 0;
}

}  // namespace pileus
