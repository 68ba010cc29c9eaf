// SPDX-License-Identifier: Apache-2.0
// The files of one frame: they appear together or not at all.
// in: pictures and a report -> out: files without a name, which get theirs at the end.
// docs/program.md
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "platform/file.h"
#include "src/base/status.h"
#include "src/io/images/image_file.h"
#include "src/plan/report.h"

namespace pileus {

class OutputSet {
public:
    OutputSet() = default;
    OutputSet(const OutputSet&) = delete;
    OutputSet& operator=(const OutputSet&) = delete;
    /// Takes back what was not kept, the last file first.
    ~OutputSet() {
        while (!files_.empty()) files_.pop_back();
    }

    /// A file that cannot be written: kIo.
    Status add(const std::string& path, Span<const char> bytes);
    /// Errors: those of encode_image; a file that cannot be written: kIo.
    Status add_image(const Image& image, const std::string& path, const ToneSettings& tone);
    Status add_report(const Report& report, const std::string& path);
    Status add_bytes(Span<const char> bytes, const std::string& path) { return add(path, bytes); }

    /// Gives all files their names, writes `text` to the standard output, and lets the files stay.
    /// A fault is kIo: the files are taken back, and older ones return. Takes no memory unless
    /// there is a fault: where it ends the program nothing could be taken back.
    Status commit(const std::string& text);

private:
    struct File {
        std::string path;
        std::unique_ptr<NewFile> file;
    };

    std::vector<File> files_;
};

}  // namespace pileus
