// SPDX-License-Identifier: Apache-2.0
// Numbers to and from text, the same on every system: with a point, whatever the process's locale.
// in: a number -> out: its digits; in: digits -> out: a number. {fmt}, fast_float, C++17 <charconv>
#pragma once
#include <charconv>
#include <string>
#include <type_traits>

namespace pileus {

/// As few digits as tell `value` from all others of its type, as std::to_chars writes them.
std::string number_text(double value);
std::string number_text(float value);

/// At most `digits` significant digits, 1 to 17, as printf's %g writes them.
std::string number_text(double value, int digits);

/// Reads the number at the front of [begin, end), rounded to the nearest, as std::from_chars does:
/// no "+" and no blanks before it; "inf" and "nan" are numbers. `value` stays as it is on a fault.
/// Not every C++ library has std::from_chars of a floating type.
std::from_chars_result number_from(const char* begin, const char* end, double& value,
                                   std::chars_format form = std::chars_format::general);
std::from_chars_result number_from(const char* begin, const char* end, float& value);

template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
std::from_chars_result number_from(const char* begin, const char* end, Integer& value) {
    return std::from_chars(begin, end, value);
}

}  // namespace pileus
