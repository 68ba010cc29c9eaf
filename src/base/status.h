// SPDX-License-Identifier: Apache-2.0
// What every stage returns: fine, or what is wrong, where and what would be allowed.
// in: nothing -> out: a code that becomes the program's exit status, and lines for a person.
// docs/scene.md lists the form of the lines.
#pragma once
#include <string>

#include "src/base/printable.h"

namespace pileus {

/// The program's exit status is the value.
enum class Code : int { kOk = 0, kCheckFailed = 1, kBadInput = 2, kLimit = 3, kIo = 4 };

/// Result of a step that can fail. `message` holds one line per fault, without a final newline. It
/// is made by the functions below, which let no control character through but the line feed:
/// whatever a caller quotes, a terminal can show it.
struct [[nodiscard]] Status {
    Code code = Code::kOk;
    std::string message;

    explicit operator bool() const { return code == Code::kOk; }

    static Status ok() { return {}; }
    static Status bad_input(std::string_view text) { return fault(Code::kBadInput, text); }
    static Status limit(std::string_view text) { return fault(Code::kLimit, text); }
    static Status io(std::string_view text) { return fault(Code::kIo, text); }
    static Status check_failed(std::string_view text) { return fault(Code::kCheckFailed, text); }

private:
    static Status fault(Code code, std::string_view text) { return {code, printable_lines(text)}; }
};

}  // namespace pileus

/// Return early when a step failed.
#define PILEUS_TRY(expression)                          \
    do {                                                \
        ::pileus::Status pileus_status_ = (expression); \
        if (!pileus_status_) return pileus_status_;     \
    } while (0)
