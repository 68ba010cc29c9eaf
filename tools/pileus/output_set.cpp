// SPDX-License-Identifier: Apache-2.0
// Holds the files of a frame, unseen, until all of them are whole.
// in: pictures and a report -> out: see output_set.h.
// docs/program.md
#include "tools/pileus/output_set.h"

#include "src/base/file.h"
#include "src/plan/report_json.h"
#include "tools/pileus/command.h"

namespace pileus {

namespace {

Status fault(const std::string& path, FileResult result) {
    return result ? Status::ok() : write_fault(path, result);
}

}  // namespace

Status OutputSet::add(const std::string& path, Span<const char> bytes) {
    files_.push_back({path, std::make_unique<NewFile>()});
    NewFile& file = *files_.back().file;
    PILEUS_TRY(fault(path, file.begin(path.c_str())));
    return fault(path, file.write(bytes.data, bytes.size));
}

Status OutputSet::add_image(const Image& image, const std::string& path, const ToneSettings& tone) {
    Buffer<char> bytes;
    PILEUS_TRY(encode_image(image, path, tone, bytes));
    return add(path, bytes.span());
}

Status OutputSet::add_report(const Report& report, const std::string& path) {
    const std::string text = report_json(report);
    return add(path, {text.data(), text.size()});
}

Status OutputSet::commit(const std::string& text) {
    for (File& entry : files_) PILEUS_TRY(fault(entry.path, entry.file->publish()));
    PILEUS_TRY(print(text));
    for (File& entry : files_) entry.file->keep();
    return Status::ok();
}

}  // namespace pileus
