// SPDX-License-Identifier: Apache-2.0
// See number_text.h.
#include "src/base/number_text.h"

#include <charconv>

namespace pileus {
namespace {

/// More than any number's digits.
constexpr std::size_t kMaxDigits = 40;

}  // namespace

std::string number_text(double value) {
    char text[kMaxDigits];
    return std::string(text, std::to_chars(text, text + kMaxDigits, value).ptr);
}

std::string number_text(float value) {
    char text[kMaxDigits];
    return std::string(text, std::to_chars(text, text + kMaxDigits, value).ptr);
}

std::string number_text(double value, int digits) {
    char text[kMaxDigits];
    const auto end =
        std::to_chars(text, text + kMaxDigits, value, std::chars_format::general, digits);
    return std::string(text, end.ptr);
}

}  // namespace pileus
