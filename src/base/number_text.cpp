// SPDX-License-Identifier: Apache-2.0
// See number_text.h.
#include "src/base/number_text.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace pileus {
namespace {

/// Digits that {fmt} wrote, laid out in the shorter of the two forms; in the plain one where both
/// are as long.
template <class Number>
std::string shortest_text(Number value) {
    const std::string text = fmt::format("{}", value);
    if (!std::isfinite(value) || value == 0) return text;
    const std::size_t sign = text[0] == '-', mark = text.find('e');
    std::string digits;
    // Of the first digit, as a power of ten.
    int exponent = mark == std::string::npos ? 0 : std::atoi(text.c_str() + mark + 1);
    bool behind = false;
    for (std::size_t i = sign; i < text.size() && i != mark; ++i) {
        behind = behind || text[i] == '.';
        if (text[i] == '.') continue;
        if (!behind && !digits.empty()) ++exponent;
        if (behind && digits.empty()) --exponent;
        if (text[i] != '0' || !digits.empty()) digits += text[i];
    }
    while (digits.back() == '0') digits.pop_back();
    const int count = int(digits.size()), size = std::abs(exponent);
    const int scientific = count + (count > 1) + (size < 100 ? 4 : 5);
    const bool whole = exponent >= count - 1;
    const int plain = whole ? exponent + 1 : exponent < 0 ? 1 + size + count : count + 1;
    if (plain > scientific) {
        if (count > 1) digits.insert(1, ".");
        return text.substr(0, sign) + digits +
               fmt::format("e{}{:02}", exponent < 0 ? '-' : '+', size);
    }
    // Digits beyond the shortest ones are those of the number, no zeros.
    if (whole) return fmt::format("{:.0f}", value);
    if (exponent < 0)
        digits.insert(0, "0." + std::string(std::size_t(size - 1), '0'));
    else
        digits.insert(std::size_t(exponent + 1), ".");
    return text.substr(0, sign) + digits;
}

/// What fast_float reads as infinite or 0 without a fault is out of range where the text says
/// neither.
template <class Number>
std::from_chars_result read(const char* begin, const char* end, Number& value,
                            std::chars_format form) {
    Number found = 0;
    const auto result = fast_float::from_chars(begin, end, found,
                                               form == std::chars_format::fixed
                                                   ? fast_float::chars_format::fixed
                                                   : fast_float::chars_format::general);
    if (result.ec != std::errc()) return {result.ptr, result.ec};
    const char* digit = begin + (*begin == '-');
    bool beyond = std::isinf(found) && *digit != 'i' && *digit != 'I';
    if (found == 0)
        for (; digit < result.ptr && *digit != 'e' && *digit != 'E'; ++digit)
            beyond = beyond || (*digit >= '1' && *digit <= '9');
    if (beyond) return {result.ptr, std::errc::result_out_of_range};
    value = found;
    return {result.ptr, std::errc()};
}

}  // namespace

std::string number_text(double value) { return shortest_text(value); }

std::string number_text(float value) { return shortest_text(value); }

std::string number_text(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

std::from_chars_result number_from(const char* begin, const char* end, double& value,
                                   std::chars_format form) {
    return read(begin, end, value, form);
}

std::from_chars_result number_from(const char* begin, const char* end, float& value) {
    return read(begin, end, value, std::chars_format::general);
}

}  // namespace pileus
