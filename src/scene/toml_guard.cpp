// SPDX-License-Identifier: Apache-2.0
// Refuses scene text whose nesting would exhaust the stack of a recursive parser.
// in: untrusted text -> out: fine, or the place where the nesting becomes too deep.
// TOML 1.0, sections Keys, String and Table; limits in docs/scene.md.
#include "src/scene/toml_tree.h"

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

}  // namespace

bool nesting_is_bounded(std::string_view text, SyntaxFault& fault) {
    Cursor c;
    c.text = text;
    int brackets = 0, dots = 0;
    while (!c.done()) {
        const char ch = c.now();
        if (ch == '#') {
            skip_comment(c);
            continue;
        }
        if (ch == '"' || ch == '\'') {
            skip_string(c);
            continue;
        }
        if (ch == '[' || ch == '{') ++brackets;
        if ((ch == ']' || ch == '}') && brackets > 0) --brackets;
        if (ch == '.') ++dots;
        if (ch == '[' || ch == '{' || ch == '=' || ch == ',' || ch == '\n') dots = 0;
        if (brackets > kMaxBrackets || dots > kMaxDots) {
            fault.line = c.line;
            fault.column = static_cast<int>(c.at - c.line_start) + 1;
            fault.what = brackets > kMaxBrackets ? "nested too deeply, allowed: 32 brackets"
                                                 : "key with too many parts, allowed: 32 dots";
            return false;
        }
        c.step();
    }
    return true;
}

}  // namespace pileus
