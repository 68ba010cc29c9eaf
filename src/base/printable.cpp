// SPDX-License-Identifier: Apache-2.0
// See printable.h.
// in: any bytes -> out: valid UTF-8 without a control character.
// Unicode 15, table 3-7 (well-formed UTF-8)
#include "src/base/printable.h"

namespace pileus {
namespace {

unsigned byte_at(std::string_view text, std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

bool is_between(unsigned byte, unsigned low, unsigned high) { return byte >= low && byte <= high; }

/// Bytes of the character that begins at `at`, if it is one that may be shown; else 0.
std::size_t shown_bytes(std::string_view text, std::size_t at) {
    const unsigned first = byte_at(text, at), second = byte_at(text, at + 1);
    if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
    // Two bytes; U+0080 to U+009F are control characters as well.
    if (is_between(first, 0xC2, 0xDF))
        return is_between(second, first == 0xC2 ? 0xA0 : 0x80, 0xBF) ? 2 : 0;
    if (!is_between(byte_at(text, at + 2), 0x80, 0xBF)) return 0;
    // Three bytes: neither longer than needed nor half of a surrogate pair.
    if (is_between(first, 0xE0, 0xEF))
        return is_between(second, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) ? 3 : 0;
    // Four bytes: neither longer than needed nor beyond U+10FFFF.
    if (!is_between(first, 0xF0, 0xF4) || !is_between(byte_at(text, at + 3), 0x80, 0xBF)) return 0;
    return is_between(second, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) ? 4 : 0;
}

std::string escaped(std::string_view text, std::size_t longest, std::string_view ending,
                    bool keep_line_feeds) {
    static const char* const kHex = "0123456789abcdef";
    std::string shown;
    for (std::size_t at = 0; at < text.size();) {
        if (at >= longest) return shown.append(ending);
        const std::size_t count = shown_bytes(text, at);
        if (count > 0 || (keep_line_feeds && text[at] == '\n')) {
            const std::size_t taken = count > 0 ? count : 1;
            shown.append(text.substr(at, taken));
            at += taken;
            continue;
        }
        const unsigned byte = byte_at(text, at++);
        shown += "\\x";
        shown += kHex[byte >> 4];
        shown += kHex[byte & 15];
    }
    return shown;
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest, std::string_view ending) {
    return escaped(text, longest, ending, false);
}

std::string printable_lines(std::string_view text) {
    return escaped(text, std::string_view::npos, "", true);
}

}  // namespace pileus
