// SPDX-License-Identifier: Apache-2.0
// What the readers of text volumes share: words, numbers, comments, and the place of a fault.
// in: bytes of a text that nobody has checked -> out: numbers, or one line file:line:column.
// docs/formats.md
#pragma once
#include <cstdint>
#include <string>

#include "src/base/printable.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

constexpr std::uint64_t kMaxTextBytes = std::uint64_t{1} << 36;

/// Bytes of a file's start that hold the parameters of any honest text volume.
constexpr std::uint64_t kTextStartBytes = std::uint64_t{1} << 16;

/// Bytes [at, end) of the text.
struct TextRange {
    std::size_t at = 0, end = 0;
};

/// Space, tab, line feed, vertical tab, form feed, carriage return; no locale.
inline bool is_text_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

class TextScan {
public:
    /// `file` opens every line of a fault. `separator` ends a number beside white space and '#'.
    /// A mark of UTF-8 before the text is no part of it: text_ begins behind it, and so do places.
    TextScan(const std::string& file, Span<const char> text, char separator = ' ')
        : file_(file), text_(without_mark(text)), separator_(separator) {}

    /// kBadInput, opened with file:line:column of byte `at`, counted from 1; `what` is made
    /// printable and cut to 300 bytes.
    Status fault(std::size_t at, const std::string& what) const;
    /// The word at a place, made printable; of more than 40 bytes the first 40.
    std::string token(std::size_t at, std::size_t end) const;
    /// All of it. Places of the text that was given are others where that began with a mark.
    TextRange whole() const { return {0, text_.size}; }
    bool holds(const TextRange& range, char c) const {
        for (std::size_t at = range.at; at < range.end; ++at)
            if (text_[at] == c) return true;
        return false;
    }
    /// Passes white space and comments, which run from '#' to the end of their line.
    void skip(TextRange& range) const;
    /// Takes the next line that holds more than white space and comment: `line` ends before its
    /// comment. False at the end of the text.
    bool next_line(TextRange& rest, TextRange& line) const;
    /// Reads a number and passes it. Too small for the type counts as zero, too large or no number
    /// at all is a fault. For std::int64_t, float and double; "inf" and "nan" are read as such.
    template <class Number>
    Status number(TextRange& range, const std::string& key, Number& value) const;

protected:
    const std::string& file_;
    Span<const char> text_;
    char separator_;
};

}  // namespace pileus
