// SPDX-License-Identifier: Apache-2.0
// Numbers and blocks as binary files pack them: halves, zlib, blosc.
// in: bytes that nobody has checked -> out: numbers, bytes, or one line.
// docs/formats.md
#pragma once
#include <cstdint>
#include <string>

#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/io/text/byte_cursor.h"

namespace pileus {

/// A number of 2, 4 or 8 bytes, little-endian, rounded to the nearest float.
float packed_number(const unsigned char* from, unsigned bytes);

/// Unpacks `count` bytes, all of them, which must give exactly `bytes`; by blosc or else zlib.
Status inflate_block(const ByteCursor& in, bool blosc, const unsigned char* packed,
                     std::uint64_t count, unsigned char* to, std::uint64_t bytes);

/// Unpacks a gzip file (RFC 1952), its members one after the other, into at most `most` bytes and
/// what reading_limit.h leaves; more: kLimit, before memory is taken. Behind the last member there
/// may be zeros, as gzip itself passes over, and nothing else.
Status inflate_gzip(const std::string& name, Span<const char> packed, std::uint64_t most,
                    Buffer<char>& out);

/// zlib of `bytes` from `from`; how many bytes it took, or 0 where that is not fewer, there is no
/// room, or zlib was left out of the build.
std::uint64_t deflate_block(const unsigned char* from, std::uint64_t bytes, unsigned char* to,
                            std::uint64_t room);

/// Which compressions this build reads: "zlib yes, blosc no".
std::string packing_library_text();

}  // namespace pileus
