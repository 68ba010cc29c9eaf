// SPDX-License-Identifier: Apache-2.0
// The files of one frame: they appear together or not at all.
// in: pictures and a report -> out: hidden files beside their places, renamed at the end.
// docs/program.md
#pragma once
#include <string>
#include <vector>

#include "src/base/report.h"
#include "src/base/status.h"
#include "src/io/image_file.h"

namespace pileus {

class OutputSet {
public:
    OutputSet() = default;
    OutputSet(const OutputSet&) = delete;
    OutputSet& operator=(const OutputSet&) = delete;
    /// Takes all files away unless they were kept.
    ~OutputSet();

    /// Errors: those of write_image and write_report, naming `path`.
    Status add_image(const Image& image, const std::string& path, const ToneSettings& tone);
    Status add_report(const Report& report, const std::string& path);

    /// Gives all files their names; a fault is kIo.
    Status commit();
    /// Lets the files outlive the set.
    void keep() { kept_ = true; }

private:
    struct File {
        std::string path, staged;
    };
    std::string stage(const std::string& path);

    std::vector<File> files_;
    std::size_t renamed_ = 0;
    bool kept_ = false;
};

}  // namespace pileus
