// SPDX-License-Identifier: Apache-2.0
// The mark that some editors put before a text in UTF-8: the bytes EF BB BF.
// in: the bytes of a text -> out: those behind the mark.
// RFC 3629, section 6; docs/formats.md, "Texts".
#pragma once
#include "src/base/span.h"

namespace pileus {

/// A text without the mark that it may begin with. Every reader of texts passes through here.
inline Span<const char> without_mark(Span<const char> text) {
    const bool marked =
        text.size >= 3 && text[0] == '\xef' && text[1] == '\xbb' && text[2] == '\xbf';
    return marked ? text.part(3, text.size - 3) : text;
}

}  // namespace pileus
