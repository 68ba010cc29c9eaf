// SPDX-License-Identifier: Apache-2.0
// Reads the head of an OpenEXR file before the library does, which trusts the sizes in it.
// in: the bytes of a file -> out: fine, or what the head claims that the file cannot hold.
// OpenEXR file layout; docs/formats.md
#pragma once
#include <cstdint>
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// Walks through the attributes of all parts. Attributes that end behind the file, deep parts,
/// sizes below 1: kBadInput; a window, a tile or the rows packed together that need more than
/// `most_pixels`, or more bytes than a file of this length can mean: kLimit.
Status check_exr_head(const std::string& name, Span<const char> bytes, std::uint64_t most_pixels);

/// Bytes that a file of `file_bytes` may hold once decoded: real compression stays below 2048 to
/// one.
std::uint64_t plausible_exr_bytes(std::uint64_t file_bytes);

}  // namespace pileus
