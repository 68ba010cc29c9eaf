// SPDX-License-Identifier: Apache-2.0
// What the readers of text volumes share.
// in: bytes of a text -> out: see text_scan.h.
// docs/formats.md
#include "src/io/text/text_scan.h"

#include <cstdint>
#include <type_traits>

#include "src/base/number_text.h"

namespace pileus {

Status TextScan::fault(std::size_t at, const std::string& what) const {
    std::size_t row = 1, column = 1;
    for (std::size_t i = 0; i < at && i < text_.size; ++i) {
        ++column;
        if (text_[i] == '\n') ++row, column = 1;
    }
    return Status::bad_input(file_ + ':' + std::to_string(row) + ':' + std::to_string(column) +
                             ": " + printable_line(what));
}

std::string TextScan::token(std::size_t at, std::size_t end) const {
    constexpr std::size_t kLongest = 40;
    if (at >= end) return "the end of the text";
    std::string word;
    for (; at < end && word.size() < kLongest; ++at) {
        if (is_text_space(text_[at])) break;
        if (separator_ != ' ' && text_[at] == separator_) break;
        word += text_[at];
    }
    return word.empty() ? std::string(1, separator_) : printable(word);
}

void TextScan::skip(TextRange& range) const {
    while (range.at < range.end) {
        if (text_[range.at] == '#')
            while (range.at < range.end && text_[range.at] != '\n') ++range.at;
        else if (is_text_space(text_[range.at]))
            ++range.at;
        else
            return;
    }
}

bool TextScan::next_line(TextRange& rest, TextRange& line) const {
    skip(rest);
    if (rest.at >= rest.end) return false;
    line.at = rest.at;
    while (rest.at < rest.end && text_[rest.at] != '\n' && text_[rest.at] != '#') ++rest.at;
    line.end = rest.at;
    while (rest.at < rest.end && text_[rest.at] != '\n') ++rest.at;
    if (rest.at < rest.end) ++rest.at;
    return true;
}

template <class Number>
Status TextScan::number(TextRange& range, const std::string& key, Number& value) const {
    const char* begin = text_.data + range.at;
    const char* end = text_.data + range.end;
    if (begin + 1 < end && *begin == '+' && begin[1] != '-') ++begin;
    const std::from_chars_result result = number_from(begin, end, value);
    const bool separated = result.ptr == end || is_text_space(*result.ptr) || *result.ptr == '#' ||
                           *result.ptr == separator_;
    if (result.ec == std::errc() && separated) {
        range.at = std::size_t(result.ptr - text_.data);
        return Status::ok();
    }
    const std::string word = token(range.at, range.end);
    if (result.ec != std::errc::result_out_of_range || !separated)
        return fault(range.at, key + ": not a number, " + word);
    if constexpr (std::is_floating_point<Number>::value) {
        double wide = 0;
        const bool fits = number_from(begin, end, wide).ec == std::errc();
        const bool tiny =
            fits ? wide < 1 && wide > -1
                 : word.find("e-") != std::string::npos || word.find("E-") != std::string::npos;
        if (tiny) {
            value = 0;
            range.at = std::size_t(result.ptr - text_.data);
            return Status::ok();
        }
    }
    return fault(range.at, key + ": too large, " + word);
}

template Status TextScan::number(TextRange&, const std::string&, std::int64_t&) const;
template Status TextScan::number(TextRange&, const std::string&, float&) const;
template Status TextScan::number(TextRange&, const std::string&, double&) const;

}  // namespace pileus
