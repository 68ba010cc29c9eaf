// SPDX-License-Identifier: Apache-2.0
// What every stage returns: fine, or what is wrong, where and what would be allowed.
// in: nothing -> out: a code that becomes the program's exit status, and lines for a person.
// docs/scene.md lists the form of the lines.
#pragma once
#include <string>
#include <utility>

namespace pileus {

/// The program's exit status is the value.
enum class Code : int { kOk = 0, kCheckFailed = 1, kBadInput = 2, kLimit = 3, kIo = 4 };

/// Result of a step that can fail. `message` holds one line per fault, without a final newline.
struct [[nodiscard]] Status {
    Code code = Code::kOk;
    std::string message;

    explicit operator bool() const { return code == Code::kOk; }

    static Status ok() { return {}; }
    static Status bad_input(std::string text) { return {Code::kBadInput, std::move(text)}; }
    static Status limit(std::string text) { return {Code::kLimit, std::move(text)}; }
    static Status io(std::string text) { return {Code::kIo, std::move(text)}; }
};

/// `text` as one short line that a terminal can show: cut to 300 bytes, control characters as '?'.
/// For what a message quotes from a file that nobody vouches for.
inline std::string printable_line(const std::string& text) {
    constexpr std::size_t kLongest = 300;
    std::string line = text.substr(0, kLongest);
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    return line;
}

}  // namespace pileus

/// Return early when a step failed.
#define PILEUS_TRY(expression)                          \
    do {                                                \
        ::pileus::Status pileus_status_ = (expression); \
        if (!pileus_status_) return pileus_status_;     \
    } while (0)
