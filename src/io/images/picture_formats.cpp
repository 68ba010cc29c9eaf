// SPDX-License-Identifier: Apache-2.0
// The table of picture formats.
// in: one row for each -> out: see src/scene/rows/picture_format.h.
// docs/formats.md; docs/contributing.md, "Add a file format".
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/scene/rows/picture_format.h"

namespace pileus {
namespace {

#ifdef PILEUS_WITH_OPENEXR
constexpr bool kHasExr = true;
#else
constexpr bool kHasExr = false;
#endif
#ifdef PILEUS_WITH_PNG
constexpr bool kHasPng = true;
#else
constexpr bool kHasPng = false;
#endif

using EncodeFloats = Status (*)(const Image&, Buffer<char>&);
using EncodeCodes = Status (*)(int, int, Span<const std::uint8_t>, Buffer<char>&);

/// Formats of floats as they are; of 8 bits after tone mapping.
template <EncodeFloats kEncode>
Status floats(const Image& image, const ToneSettings&, Buffer<char>& bytes) {
    return kEncode(image, bytes);
}
template <EncodeCodes kEncode>
Status codes(const Image& image, const ToneSettings& tone, Buffer<char>& bytes) {
    Buffer<std::uint8_t> rgb;
    PILEUS_TRY(tone_map_8bit(image, tone, rgb));
    return kEncode(image.width, image.height, rgb.span(), bytes);
}

/// A picture that is a map says so in its file.
Status png_of(const Image& image, const ToneSettings& tone, Buffer<char>& bytes) {
    Buffer<std::uint8_t> rgb;
    PILEUS_TRY(tone_map_8bit(image, tone, rgb));
    std::vector<std::pair<std::string, std::string>> texts;
    for (const auto& [name, text] : image.origin)
        for (const char* of_maps : {"extent_m", "world_file", "projection"})
            if (name == of_maps) texts.emplace_back("pileus." + name, text);
    return encode_png(image.width, image.height, rgb.span(), texts, bytes);
}

// One row for a format: extension, title; radiance; library, built in; writer, reader.
constexpr PictureFormat kFormats[] = {
    {".exr", "OpenEXR", true, "PILEUS_OPENEXR", kHasExr, floats<encode_exr>, decode_exr},
    {".png", "PNG", false, "PILEUS_PNG", kHasPng, png_of, decode_png},
    {".pfm", "PFM", true, nullptr, true, floats<encode_pfm>, decode_pfm},
    {".ppm", "PPM", false, nullptr, true, codes<encode_ppm>, nullptr},
    {".nc", "NetCDF", true, nullptr, true, floats<encode_netcdf_picture>, nullptr},
};

}  // namespace

Span<const PictureFormat> picture_formats() {
    return {kFormats, sizeof kFormats / sizeof kFormats[0]};
}

const PictureFormat* picture_format_of(const std::string& path) {
    return row_of_extension(kFormats, path);
}

bool is_written(const PictureFormat& format) { return format.encode != nullptr; }
bool is_radiance(const PictureFormat& format) { return format.radiance && is_read(format); }
bool is_read(const PictureFormat& format) { return format.decode != nullptr; }

std::string picture_extensions(bool (*use)(const PictureFormat&), const char* between) {
    return extensions_of(kFormats, between, use);
}

}  // namespace pileus
