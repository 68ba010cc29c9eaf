// SPDX-License-Identifier: Apache-2.0
// Pictures to files and back.
// in: an Image -> out: .exr .pfm .nc (radiance), .png .ppm (8-bit, tone mapped).
// docs/formats.md
#pragma once
#include <cstdint>
#include <string>

#include "src/base/buffer.h"
#include "src/base/digest.h"
#include "src/base/limits.h"
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/io/images/develop/develop.h"
#include "src/io/images/image.h"

namespace pileus {

constexpr int kMaxImageSide = 32768;
constexpr std::uint64_t kMaxImagePixels = std::uint64_t{1} << 28;
constexpr std::size_t kMaxChannels = 64;

/// Writes `image` in the format of the extension; `tone` matters to .png and .ppm only. An unknown
/// extension, a library left out of this build or a malformed image: kBadInput; memory: kLimit;
/// writing failed: kIo. After any fault no new or partial file is left.
Status write_image(const Image& image, const std::string& path, const ToneSettings& tone);

/// The bytes that write_image would write to `path`; its faults before the writing.
Status encode_image(const Image& image, const std::string& path, const ToneSettings& tone,
                    Buffer<char>& bytes);

/// Whether write_image has a writer for the extension of `path`; the fault it would return.
Status can_write_image(const std::string& path);

/// Reads .exr (half, float or whole-number channels of any name, first part, its data window) or
/// .pfm (channels R G B) into floats. Missing or malformed: kBadInput; more than `most_pixels` or
/// than memory: kLimit.
Status read_image(const std::string& path, Image& image,
                  std::uint64_t most_pixels = kMaxImagePixels);

/// 16 hex digits: XXH3 64 over the float32 bits of R G B A of each pixel, rows from the top. A
/// colour that is not there counts as Y, or 0 without that; A as 1.
std::string pixel_hash(const Image& image);
/// The same of a picture that comes in bands of rows, from the top.
void add_pixels(const Image& band, Digest& digest);

/// Checks size and channels (names not empty and all different, planes of the right length).
Status check_image(const Image& image);

/// Finds R, G and B, or Y for all three; kBadInput where there are none.
Status color_channels(const Image& image, const Channel* (&rgb)[3]);

/// Checks the size of a picture about to be read: kBadInput below 1, kLimit above the limits.
Status check_image_size(const std::string& where, std::int64_t width, std::int64_t height,
                        std::uint64_t most_pixels = kMaxImagePixels);

/// Reads the colours of a picture of any format that has a reader, within the limit `file`. Faults
/// of read_image and color_channels.
Status read_colours(const std::string& path, const Limits& limits, std::uint64_t max_pixels,
                    Image& image, const Channel* (&rgb)[3]);

// One file per format; each makes or takes the bytes of a whole file.
Status encode_exr(const Image& image, Buffer<char>& bytes);
Status decode_exr(const std::string& name, Span<const char> bytes, Image& image,
                  std::uint64_t most_pixels = kMaxImagePixels);
Status encode_png(int width, int height, Span<const std::uint8_t> rgb, Buffer<char>& bytes);
/// The same with chunks tEXt: names and texts, Latin letters.
Status encode_png(int width, int height, Span<const std::uint8_t> rgb,
                  const std::vector<std::pair<std::string, std::string>>& texts,
                  Buffer<char>& bytes);
/// Any PNG file as display-linear R G B; where it has alpha, premultiplied, and A. 16 bits
/// become 8.
Status decode_png(const std::string& name, Span<const char> bytes, Image& image,
                  std::uint64_t most_pixels = kMaxImagePixels);
/// Each channel as a variable; on metres where `origin` has an extent_m and a projection.
Status encode_netcdf_picture(const Image& image, Buffer<char>& bytes);
Status encode_pfm(const Image& image, Buffer<char>& bytes);
Status decode_pfm(const std::string& name, Span<const char> bytes, Image& image,
                  std::uint64_t most_pixels = kMaxImagePixels);

// What looks at the head of an OpenEXR file before the library does, which trusts the sizes in it.

/// Walks through the attributes of all parts. Attributes that end behind the file, deep parts,
/// sizes below 1: kBadInput; a window, a tile or the rows packed together that need more than
/// `most_pixels`, or more bytes than a file of this length can mean: kLimit.
Status check_exr_head(const std::string& name, Span<const char> bytes, std::uint64_t most_pixels);

/// Bytes that a file of `file_bytes` may hold once decoded: real compression stays below 2048 to
/// one.
std::uint64_t plausible_exr_bytes(std::uint64_t file_bytes);

}  // namespace pileus
