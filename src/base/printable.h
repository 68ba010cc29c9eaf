// SPDX-License-Identifier: Apache-2.0
// The one place that makes text fit for a message, and that knows how texts begin.
// in: text that nobody vouches for -> out: valid UTF-8 without a control character.
// Unicode 15, chapter 3.9 (well-formed UTF-8) and general category Cc; docs/scene.md, "Messages".
#pragma once
#include <string>
#include <string_view>

#include "src/base/span.h"

namespace pileus {

/// `text` as a terminal can show it: control characters (codes 0 to 31, 127 and 128 to 159) and
/// bytes that are no UTF-8 become \xNN, byte by byte. Cut in front of the first character that
/// begins `longest` bytes or more into the text; `ending` then says so. Sound text comes back as it
/// is.
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos,
                      std::string_view ending = "");

/// The same for lines: line feeds stay, for they part the faults of one message.
std::string printable_lines(std::string_view text);

/// `text` as one short line, cut at 300 bytes: for what a message quotes from a file.
inline std::string printable_line(std::string_view text) { return printable(text, 300); }

/// A to Z in small letters, whatever the locale.
inline std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

/// A text without the mark that it may begin with. Every reader of texts passes through here.
inline Span<const char> without_mark(Span<const char> text) {
    const bool marked =
        text.size >= 3 && text[0] == '\xef' && text[1] == '\xbb' && text[2] == '\xbf';
    return marked ? text.part(3, text.size - 3) : text;
}

}  // namespace pileus
