// SPDX-License-Identifier: Apache-2.0
// Numbers as text for messages and files: with a point, whatever the process's locale.
// in: a number -> out: its digits. C++17, <charconv>.
#pragma once
#include <string>

namespace pileus {

/// As few digits as tell `value` from all others of its type.
std::string number_text(double value);
std::string number_text(float value);

/// At most `digits` significant digits, 1 to 17, as printf's %g writes them.
std::string number_text(double value, int digits);

}  // namespace pileus
