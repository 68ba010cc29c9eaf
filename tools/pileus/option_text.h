// SPDX-License-Identifier: Apache-2.0
// Numbers and ranges on the command line, read the same in every locale.
// in: an option's name and the text behind it -> out: a checked value, or a line that says what is
// allowed. docs/program.md
#pragma once
#include <cstdint>
#include <string>

#include "src/base/status.h"

namespace pileus {

/// A whole number within [low, high], in any form that a scene takes: 5000000, 5_000_000, 5e6; else
/// kBadInput.
Status read_integer(const char* option, const std::string& text, std::int64_t low,
                    std::int64_t high, std::int64_t& value);

/// A finite number within [low, high], in the same forms; else kBadInput.
Status read_number(const char* option, const std::string& text, double low, double high,
                   double& value);

/// "A-B" or "A", whole numbers with 0 <= A <= B < frames; else kBadInput.
Status read_frames(const std::string& text, int frames, int& first, int& last);

/// Gathers faults: the first code, one message line after the other.
void add_fault(const Status& fault, Status& all);

/// "1.5 MiB"; whole bytes below 1 KiB.
std::string bytes_text(std::uint64_t bytes);

}  // namespace pileus
