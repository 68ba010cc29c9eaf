// SPDX-License-Identifier: Apache-2.0
// Portable float map: three floats a pixel and nothing else.
// in: R G B -> out: "PF", size, "-1" (little-endian), rows from the bottom; and back.
// Debevec, "PFM format"; docs/formats.md
#include "src/base/number_text.h"
#include "src/io/images/image_file.h"

namespace pileus {

namespace {

void put_float(char* at, float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    for (int i = 0; i < 4; ++i) at[i] = char(bits >> (8 * i) & 255);
}

float get_float(const char* at, bool big_endian) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8 | std::uint8_t(at[big_endian ? i : 3 - i]);
    float value;
    std::memcpy(&value, &bits, 4);
    return value;
}

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The next word and the single white space after it.
bool next_word(Span<const char> bytes, std::size_t& at, Span<const char>& word) {
    constexpr std::size_t kLongest = 64;
    while (at < bytes.size && is_space(bytes[at])) ++at;
    const std::size_t begin = at;
    while (at < bytes.size && !is_space(bytes[at]) && at - begin < kLongest) ++at;
    if (at >= bytes.size || !is_space(bytes[at])) return false;
    word = {bytes.data + begin, at - begin};
    ++at;
    return true;
}

template <class Number>
bool parse(Span<const char> word, Number& value) {
    const std::from_chars_result r = number_from(word.begin(), word.end(), value);
    return r.ec == std::errc() && r.ptr == word.end();
}

struct Head {
    std::int64_t width = 0, height = 0;
    std::size_t planes = 3, data_at = 0;
    bool big_endian = false;
};

Status read_head(const std::string& name, Span<const char> bytes, std::uint64_t most_pixels,
                 Head& head) {
    Span<const char> kind, width, height, scale;
    std::size_t at = 0;
    const bool whole = next_word(bytes, at, kind) && next_word(bytes, at, width) &&
                       next_word(bytes, at, height) && next_word(bytes, at, scale);
    double factor = 0;
    const bool known = whole && kind.size == 2 && kind[0] == 'P' &&
                       (kind[1] == 'F' || kind[1] == 'f') && parse(width, head.width) &&
                       parse(height, head.height) && parse(scale, factor);
    if (!known || !(factor < 0 || factor > 0))
        return Status::bad_input(name +
                                 ":1:1: head: not a PFM file, allowed: PF or Pf, width, "
                                 "height, a scale that is not 0");
    PILEUS_TRY(check_image_size(name, head.width, head.height, most_pixels));
    head.planes = kind[1] == 'F' ? 3 : 1;
    head.data_at = at;
    head.big_endian = factor > 0;
    return Status::ok();
}

}  // namespace

Status encode_pfm(const Image& image, Buffer<char>& bytes) {
    const Channel* rgb[3];
    PILEUS_TRY(color_channels(image, rgb));
    const std::size_t width = std::size_t(image.width), height = std::size_t(image.height);
    const std::string head =
        "PF\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n-1\n";
    PILEUS_TRY(bytes.resize(head.size() + std::uint64_t(width) * height * 12, "PFM file"));
    std::memcpy(bytes.data(), head.data(), head.size());
    char* at = bytes.data() + head.size();
    for (std::size_t y = height; y-- > 0;)
        for (std::size_t x = 0; x < width; ++x)
            for (const Channel* channel : rgb) {
                put_float(at, channel->pixels[y * width + x]);
                at += 4;
            }
    return Status::ok();
}

Status decode_pfm(const std::string& name, Span<const char> bytes, Image& image,
                  std::uint64_t most_pixels) {
    Head head;
    PILEUS_TRY(read_head(name, bytes, most_pixels, head));

    // Compare lengths before any memory is taken.
    const std::size_t width = std::size_t(head.width), height = std::size_t(head.height);
    const std::uint64_t wanted = std::uint64_t(width) * height * head.planes * 4;
    if (bytes.size - head.data_at != wanted)
        return Status::bad_input(name + ": data: wrong length, " +
                                 std::to_string(bytes.size - head.data_at) +
                                 " bytes, allowed: exactly " + std::to_string(wanted));
    image.width = int(head.width);
    image.height = int(head.height);
    image.channels.resize(3);
    const char* const names[3] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        image.channels[c].name = names[c];
        PILEUS_TRY(image.channels[c].pixels.resize(std::uint64_t(width) * height, name.c_str()));
    }

    // Rows come from the bottom; a single plane fills all three channels.
    const Span<const char> values = bytes.part(head.data_at, std::size_t(wanted));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t pixel = (height - 1 - y) * width + x;
                const std::size_t value = pixel * head.planes + (head.planes == 3 ? c : 0);
                image.channels[c].pixels.at(y * width + x) =
                    get_float(values.part(4 * value, 4).data, head.big_endian);
            }
    return Status::ok();
}

}  // namespace pileus
