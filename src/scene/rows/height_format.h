// SPDX-License-Identifier: Apache-2.0
// The kinds of files that hold a map of heights: their extensions, what they say, who reads them.
// in: the table in src/io/heights/height_formats.cpp -> out: rows for checks and readers.
// docs/solids.md, "Height maps"; docs/contributing.md, "Add a file format".
#pragma once
#include <cstdint>
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

struct HeightGrid;
struct HeightMapSettings;

struct HeightFormat {
    const char* extension;  ///< in lower case, with its point
    const char* title;
    bool scaled;  ///< samples are shares of a range, which the scene has to say
    bool whole;   ///< samples may be whole numbers from 0 on, which a range may be given for
    bool raw;     ///< bare numbers: the scene says how many and which
    bool placed;  ///< it may say itself where it lies
    Status (*decode)(const std::string& name, Span<const char> bytes,
                     const HeightMapSettings& settings, std::uint64_t max_triangles,
                     HeightGrid& grid);
};

/// All, in the order of messages.
Span<const HeightFormat> height_formats();

/// By the extension of a path, in upper or lower case; null where there is none.
const HeightFormat* height_format_of(const std::string& path);

/// ".png, .exr, ...".
std::string height_extensions();

}  // namespace pileus
