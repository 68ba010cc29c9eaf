// SPDX-License-Identifier: Apache-2.0
// Refuses scene text that a TOML parser may stumble over: deep nesting, stray characters.
// in: untrusted text -> out: fine, or the place of the first such fault.
// TOML 1.0, sections Spec, Keys, String and Table; limits in docs/scene.md.
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr int kMaxBrackets = 32;
constexpr int kMaxDots = 32;

struct Cursor {
    std::string_view text;
    std::size_t at = 0;
    int line = 1;
    std::size_t line_start = 0;

    bool done() const { return at >= text.size(); }
    char now() const { return text[at]; }
    void step() {
        if (text[at] == '\n') {
            ++line;
            line_start = at + 1;
        }
        ++at;
    }
};

void skip_comment(Cursor& c) {
    while (!c.done() && c.now() != '\n') c.step();
}

bool is_ascii(char ch) { return static_cast<unsigned char>(ch) < 0x80; }

/// Passes over one string of any of TOML's four forms; an unclosed one ends where a parser gives
/// up.
void skip_string(Cursor& c) {
    const char quote = c.now();
    const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
    const bool multi_line = c.text.substr(c.at, 3) == triple;
    for (int i = 0; i < (multi_line ? 3 : 1); ++i) c.step();
    while (!c.done()) {
        if (!multi_line && c.now() == '\n') return;
        if (quote == '"' && c.now() == '\\') {
            c.step();
            if (!c.done()) c.step();
            continue;
        }
        if (multi_line && c.text.substr(c.at, 3) == triple) {
            // Take up to two quotes that belong to the string before its closing three.
            while (!c.done() && c.now() == quote) c.step();
            return;
        }
        const bool closes = !multi_line && c.now() == quote;
        c.step();
        if (closes) return;
    }
}

class Guard {
public:
    explicit Guard(std::string_view text) {
        c_.text = text;
        // A byte order mark may open the text.
        if (text.substr(0, 3) == "\xEF\xBB\xBF") c_.at = c_.line_start = 3;
    }

    /// The first fault of the text, or null. Its place is then at().
    const char* run() {
        while (!c_.done()) {
            const char ch = c_.now();
            if (ch == '#') {
                skip_comment(c_);
            } else if (ch == '"' || ch == '\'') {
                skip_string(c_);
            } else {
                if (const char* fault = plain(ch)) return fault;
                c_.step();
            }
        }
        return nullptr;
    }

    const Cursor& at() const { return c_; }

private:
    const char* plain(char ch) {
        if (!is_ascii(ch)) return "character outside ASCII, allowed: in texts and comments only";
        if (ch == '[' || ch == '{') ++brackets_;
        if ((ch == ']' || ch == '}') && brackets_ > 0) --brackets_;
        if (ch == '.') ++dots_;
        if (ch == '[' || ch == '{' || ch == '=' || ch == ',' || ch == '\n') dots_ = 0;
        if (brackets_ > kMaxBrackets) return "nested too deeply, allowed: 32 brackets";
        if (dots_ > kMaxDots) return "key with too many parts, allowed: 32 dots";
        return nullptr;
    }

    Cursor c_;
    int brackets_ = 0, dots_ = 0;
};

}  // namespace

bool is_parsable(std::string_view text, SyntaxFault& fault) {
    Guard guard(text);
    const char* what = guard.run();
    if (what == nullptr) return true;
    fault.line = guard.at().line;
    fault.column = static_cast<int>(guard.at().at - guard.at().line_start) + 1;
    fault.what = what;
    return false;
}

}  // namespace pileus
