// SPDX-License-Identifier: Apache-2.0
// Writes each file under a hidden name first; a device or a pipe takes its bytes at once.
// in: pictures and a report -> out: see output_set.h.
// docs/program.md
#include "tools/pileus/output_set.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "platform/clock.h"
#include "src/base/file.h"
#include "src/io/report_json.h"

namespace pileus {

namespace {

namespace fs = std::filesystem;

/// Puts the name that the user knows into a line that holds the hidden one.
Status named(Status status, const std::string& staged, const std::string& path) {
    const std::size_t at = status.message.find(staged);
    if (at != std::string::npos) status.message.replace(at, staged.size(), path);
    return status;
}

}  // namespace

OutputSet::~OutputSet() {
    if (kept_) return;
    std::error_code ignored;
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const File& file = files_[i];
        if (file.staged != file.path) fs::remove(i < renamed_ ? file.path : file.staged, ignored);
    }
}

std::string OutputSet::stage(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        files_.push_back({path, path});
        return path;
    }

    // Follow a link to its file, so that the link survives; the extension chooses the format.
    fs::path target = path;
    if (fs::exists(status)) {
        const fs::path resolved = fs::canonical(target, error);
        if (!error) target = resolved;
    }
    const auto moment = std::uint64_t(wall_seconds() * 1e9);
    const std::string name =
        fmt::format(".pileus-{:x}-{}{}", moment, files_.size(), file_extension(path));
    std::string staged = (target.parent_path() / name).string();
    files_.push_back({target.string(), staged});
    return staged;
}

Status OutputSet::add_image(const Image& image, const std::string& path, const ToneSettings& tone) {
    const std::string staged = stage(path);
    return named(write_image(image, staged, tone), staged, path);
}

Status OutputSet::add_report(const Report& report, const std::string& path) {
    const std::string staged = stage(path);
    return named(write_report(report, staged), staged, path);
}

Status OutputSet::commit() {
    for (renamed_ = 0; renamed_ < files_.size(); ++renamed_) {
        const File& file = files_[renamed_];
        if (file.staged == file.path) continue;
        std::error_code error;
        fs::rename(file.staged, file.path, error);
        if (error) return Status::io(file.path + ": cannot write: " + error.message());
    }
    return Status::ok();
}

}  // namespace pileus
