// SPDX-License-Identifier: Apache-2.0
// Text that is fit for a message: what passes, what is escaped, where it is cut.
// in: every byte, every character, and bytes that are none -> out: pass or fail.
// docs/scene.md, "Messages"; Unicode 15, table 3-7
#include "src/base/printable.h"

#include <doctest/doctest.h>

#include "src/base/status.h"
#include "src/scene/toml/toml_tree.h"

using namespace pileus;

namespace {

/// The character of a code as UTF-8; surrogates too, although they are none.
std::string utf8(unsigned code) {
    const auto tail = [&](unsigned shift) { return char(0x80 | (code >> shift & 63)); };
    if (code < 0x80) return {char(code)};
    if (code < 0x800) return {char(0xC0 | code >> 6), tail(0)};
    if (code < 0x10000) return {char(0xE0 | code >> 12), tail(6), tail(0)};
    return {char(0xF0 | code >> 18), tail(12), tail(6), tail(0)};
}

bool is_plain(const std::string& text) {
    for (char c : text)
        if (c < 0x20 || c > 0x7E) return false;
    return true;
}

}  // namespace

TEST_CASE("printable: every character passes but the 65 control characters") {
    unsigned escaped = 0;
    for (unsigned code = 0; code <= 0x10FFFF; ++code) {
        const std::string text = utf8(code);
        const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
        const bool surrogate = code >= 0xD800 && code < 0xE000;
        const std::string shown = printable(text);
        if (!control && !surrogate && shown == text) continue;
        ++escaped;
        CHECK_MESSAGE((control || surrogate), code);
        CHECK_MESSAGE(shown.size() == 4 * text.size(), code);
        CHECK_MESSAGE(is_plain(shown), code);
    }
    CHECK(escaped == 65 + 2048);
    CHECK(printable(utf8(0x7F)) == "\\x7f");
    CHECK(printable(utf8(0x9B) + "31m") == "\\xc2\\x9b31m");
}

TEST_CASE("printable: bytes that are no UTF-8 are escaped one by one") {
    // Alone, cut short, longer than needed, beyond the last code, no lead byte.
    for (const char* text : {"\x80", "\xbf", "\xc3", "\xe2\x82", "\xf0\x9f\x98", "\xc0\xaf",
                             "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf",
                             "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xfe"}) {
        const std::string bytes = text;
        CHECK(is_plain(printable(bytes)));
        CHECK(printable(bytes).size() == 4 * bytes.size());
        CHECK(printable(bytes + "ok") == printable(bytes) + "ok");
    }
    CHECK(printable("caf\xe9") == "caf\\xe9");
    CHECK(printable("caf\xc3\xa9") == "caf\xc3\xa9");
}

TEST_CASE("printable: cuts between characters, and bounds what is no text") {
    CHECK(printable("abcdef", 3) == "abc");
    CHECK(printable("abcdef", 3, "...") == "abc...");
    CHECK(printable("abc", 3, "...") == "abc");
    CHECK(printable("ab\xc3\xa9"
                    "f",
                    3, "...") == "ab\xc3\xa9...");
    CHECK(printable(std::string(1000, '\x80'), 60).size() == 240);
    // A quote once went on to the end of any number of such bytes.
    CHECK(quote_text(std::string(100'000, '\x80')).size() == 245);
    CHECK(quote_text("a\x7f\n") == "\"a\\x7f\\x0a\"");
}

TEST_CASE("a status never holds a control character but the line feed") {
    const std::string every =
        "a\tb\rc\x1b[31md\x7f"
        "e\nf\xc2\x85g\xff";
    const std::string shown = "a\\x09b\\x0dc\\x1b[31md\\x7fe\nf\\xc2\\x85g\\xff";
    CHECK(Status::bad_input(every).message == shown);
    CHECK(Status::limit(every).message == shown);
    CHECK(Status::io(every).message == shown);
    CHECK(Status::check_failed(every).message == shown);
}
