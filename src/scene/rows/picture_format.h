// SPDX-License-Identifier: Apache-2.0
// The kinds of picture files: their extensions, what they hold, who writes and reads them.
// in: the table in src/io/images/picture_formats.cpp -> out: rows for checks, readers and writers.
// docs/formats.md; docs/contributing.md, "Add a file format".
#pragma once
#include <cstdint>
#include <string>

#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

struct Image;
struct ToneSettings;

struct PictureFormat {
    const char* extension;  ///< in lower case, with its point
    const char* title;
    bool radiance;        ///< holds floats as they are; otherwise 8 bits of a display
    const char* library;  ///< the switch that builds it in; null: needs no library
    bool built;           ///< is there in this build
    /// The bytes of a whole file; `tone` matters to those of a display.
    Status (*encode)(const Image& image, const ToneSettings& tone, Buffer<char>& bytes);
    /// Null where there is no reader.
    Status (*decode)(const std::string& name, Span<const char> bytes, Image& image,
                     std::uint64_t most_pixels);
};

/// All, in the order of messages.
Span<const PictureFormat> picture_formats();

/// By the extension of a path, in upper or lower case; null where there is none.
const PictureFormat* picture_format_of(const std::string& path);

/// Formats that can be written, read as floats or read in any way.
bool is_written(const PictureFormat& format);
bool is_radiance(const PictureFormat& format);
bool is_read(const PictureFormat& format);

/// ".exr, .png, ..." of those that `use` takes.
std::string picture_extensions(bool (*use)(const PictureFormat&), const char* between = ", ");

/// Reads a file of a format that has a reader; faults as read_image's.
Status decode_image(const PictureFormat& format, const std::string& path, Image& image,
                    std::uint64_t most_pixels);

/// For the table's row: bytes of a PPM file from 3 bytes a pixel.
Status encode_ppm(int width, int height, Span<const std::uint8_t> rgb, Buffer<char>& bytes);

}  // namespace pileus
