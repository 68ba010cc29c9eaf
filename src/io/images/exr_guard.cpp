// SPDX-License-Identifier: Apache-2.0
// Walks through the attributes of an OpenEXR file without the library.
// in: untrusted bytes -> out: see image_file.h.
// OpenEXR file layout: magic, version, then name, type, length, value until an empty name.

#include <algorithm>
#include <cstring>
#include <string_view>

#include "src/base/reading_limit.h"
#include "src/io/images/image_file.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMaxDecodedBytes = std::uint64_t{1} << 34;
constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kDeepFlag = 0x800, kPartsFlag = 0x1000;
constexpr std::size_t kLongestName = 255;

/// Types whose value the library reads by itself, whatever length the file states.
struct FixedType {
    const char* name;
    std::size_t bytes;
};
constexpr FixedType kFixedTypes[] = {
    {"box2i", 16},      {"box2f", 16},    {"chromaticities", 32},
    {"compression", 1}, {"double", 8},    {"envmap", 1},
    {"float", 4},       {"int", 4},       {"keycode", 28},
    {"m33f", 36},       {"m33d", 72},     {"m44f", 64},
    {"m44d", 128},      {"v2i", 8},       {"v2f", 8},
    {"v2d", 16},        {"v3i", 12},      {"v3f", 12},
    {"v3d", 24},        {"lineOrder", 1}, {"rational", 8},
    {"timecode", 8},    {"tiledesc", 9},  {"deepImageState", 1},
};

/// What decides how much memory the library takes for one part.
struct Part {
    std::int64_t width = 1, height = 1, tile_width = 1, tile_height = 1;
    std::uint64_t channels = 1, packed_rows = 1;
};

class Walk {
public:
    Walk(const std::string& name, Span<const char> bytes) : name_(name), bytes_(bytes) {}

    Status start(bool& many_parts);
    /// Passes one part's attributes.
    Status part(Part& part);
    bool at_zero() const { return at_ < bytes_.size && bytes_.at(at_) == 0; }

private:
    Status fault(const std::string& line) const {
        return Status::bad_input(name_ + ": EXR file: not readable, byte " + std::to_string(at_) +
                                 ": " + line);
    }
    Status word(std::string_view& text);
    Status length_of(std::string_view type, std::size_t length) const;
    Status value(std::string_view key, std::size_t length, Part& part) const;
    Status window(std::size_t length, Part& part) const;
    std::uint64_t count_channels(std::size_t& at, std::size_t end) const;
    bool texts_fit(std::size_t at, std::size_t end) const;
    std::uint32_t u32(std::size_t at) const {
        std::uint32_t bits = 0;
        for (std::size_t i = 4; i-- > 0;) bits = bits << 8 | std::uint8_t(bytes_.at(at + i));
        return bits;
    }
    std::int64_t i32(std::size_t at) const {
        const std::uint32_t bits = u32(at);
        std::int32_t number;
        std::memcpy(&number, &bits, 4);
        return number;
    }

    const std::string& name_;
    Span<const char> bytes_;
    std::size_t at_ = 0;
};

Status Walk::start(bool& many_parts) {
    if (bytes_.size < 8 || u32(0) != kMagic)
        return fault("not an OpenEXR file, allowed: the bytes 76 2f 31 01 first");
    if ((u32(4) & kDeepFlag) != 0) return fault("deep data, allowed: one value per pixel");
    many_parts = (u32(4) & kPartsFlag) != 0;
    at_ = 8;
    return Status::ok();
}

/// Takes a text that ends with a zero byte.
Status Walk::word(std::string_view& text) {
    const std::size_t begin = at_;
    while (at_ < bytes_.size && bytes_.at(at_) != 0 && at_ - begin <= kLongestName) ++at_;
    if (at_ >= bytes_.size || bytes_.at(at_) != 0) return fault("attribute: its name does not end");
    text = {bytes_.data + begin, at_ - begin};
    ++at_;
    return Status::ok();
}

/// Each channel is a name, a zero and 16 bytes; an empty name ends the list.
std::uint64_t Walk::count_channels(std::size_t& at, std::size_t end) const {
    std::uint64_t count = 0;
    for (; at < end && bytes_.at(at) != 0; at += 17, ++count)
        while (at < end && bytes_.at(at) != 0) ++at;
    return count;
}

/// A list of texts, each behind its length of 32 bits.
bool Walk::texts_fit(std::size_t at, std::size_t end) const {
    while (end - at >= 4) {
        const std::size_t length = u32(at);
        at += 4;
        if (length > end - at) return false;
        at += length;
    }
    return at == end;
}

/// Where the stated length is not the one that the library will read, it would go on in the middle
/// of a value and take its bytes for lengths.
Status Walk::length_of(std::string_view type, std::size_t length) const {
    bool sound = type != "idmanifest";
    for (const FixedType& fixed : kFixedTypes)
        if (type == fixed.name) sound = length == fixed.bytes;
    if (type == "chlist") {
        std::size_t at = at_;
        (void)count_channels(at, at_ + length);
        sound = length > 0 && at == at_ + length - 1 && bytes_.at(at) == 0;
    }
    if (type == "preview") {
        std::uint64_t pixels = 0, bytes = 0;
        sound = length >= 8 && checked_multiply(u32(at_), u32(at_ + 4), pixels) &&
                checked_multiply(pixels, 4, bytes) && bytes == length - 8;
    }
    if (type == "stringvector") sound = texts_fit(at_, at_ + length);
    if (sound) return Status::ok();
    return fault("attribute: a type or length that is not read, " + std::to_string(length) +
                 " bytes, allowed: the length of its type");
}

Status Walk::window(std::size_t length, Part& part) const {
    if (length != 16) return fault("dataWindow: wrong length, allowed: four numbers of 32 bits");
    part.width = i32(at_ + 8) - i32(at_) + 1;
    part.height = i32(at_ + 12) - i32(at_ + 4) + 1;
    return Status::ok();
}

Status Walk::value(std::string_view key, std::size_t length, Part& part) const {
    if (key == "dataWindow") return window(length, part);
    if (key == "tiles") {
        if (length != 9) return fault("tiles: wrong length, allowed: 9 bytes");
        part.tile_width = std::int64_t(u32(at_));
        part.tile_height = std::int64_t(u32(at_ + 4));
    }
    std::size_t at = at_;
    if (key == "channels") part.channels = count_channels(at, at_ + length);
    if (key == "type" && std::string_view(bytes_.data + at_, length).substr(0, 4) == "deep")
        return fault("deep data, allowed: one value per pixel");
    if (key == "compression" && length == 1) {
        static constexpr std::uint8_t rows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 0};
        const auto kind = std::uint8_t(bytes_.at(at_));
        part.packed_rows = kind < 9 ? rows[kind] : 256;
    }
    return Status::ok();
}

Status Walk::part(Part& part) {
    for (;;) {
        std::string_view key, type;
        PILEUS_TRY(word(key));
        if (key.empty()) return Status::ok();
        PILEUS_TRY(word(type));
        if (bytes_.size - at_ < 4) return fault("attribute: no length before the file's end");
        const std::size_t length = u32(at_);
        at_ += 4;
        if (length > bytes_.size - at_)
            return fault("attribute: longer than the file, " + std::to_string(length) +
                         " bytes, allowed: at most " + std::to_string(bytes_.size - at_));
        PILEUS_TRY(length_of(type, length));
        PILEUS_TRY(value(key, length, part));
        at_ += length;
    }
}

/// Refuses what the library would take memory for without having seen a pixel.
Status check_part(const std::string& name, const Part& part, std::uint64_t most_bytes,
                  std::uint64_t most_pixels) {
    PILEUS_TRY(check_image_size(name, part.width, part.height, most_pixels));
    PILEUS_TRY(check_image_size(name + ": tile", part.tile_width, part.tile_height, most_pixels));
    const std::uint64_t rows = std::max(std::uint64_t(part.height), part.packed_rows);
    const std::uint64_t pixels = std::max(std::uint64_t(part.width) * rows,
                                          std::uint64_t(part.tile_width * part.tile_height));
    std::uint64_t needed = 0;
    if (!checked_multiply(pixels * 4, part.channels, needed) || needed > most_bytes)
        return Status::limit(name + ": size: too large, " + std::to_string(needed) +
                             " bytes once decoded, allowed: at most " + std::to_string(most_bytes));
    return check_reading(name, needed);
}

}  // namespace

std::uint64_t plausible_exr_bytes(std::uint64_t file_bytes) {
    const std::uint64_t plausible = (std::uint64_t{1} << 26) + file_bytes * 2048;
    return std::min(plausible, kMaxDecodedBytes);
}

Status check_exr_head(const std::string& name, Span<const char> bytes, std::uint64_t most_pixels) {
    Walk walk(name, bytes);
    bool many_parts = false;
    PILEUS_TRY(walk.start(many_parts));
    const std::uint64_t most_bytes =
        std::min(plausible_exr_bytes(bytes.size), most_pixels * kMaxChannels * 4);
    do {
        Part part;
        PILEUS_TRY(walk.part(part));
        PILEUS_TRY(check_part(name, part, most_bytes, most_pixels));
    } while (many_parts && !walk.at_zero());
    return Status::ok();
}

}  // namespace pileus
