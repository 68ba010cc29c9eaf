// SPDX-License-Identifier: Apache-2.0
// Fuzz target: parts of pictures behind a right digest.
// in: arbitrary bytes -> out: arrays that the file is long enough for, or one line.
// docs/farm.md
#include <cstring>

#include "src/base/digest.h"
#include "src/session/parts/parts.h"
#include "tests/fuzz/target.h"

int fuzz::part(const std::uint8_t* data, std::size_t size) {
    using namespace pileus;
    Buffer<char> bytes;
    const std::size_t words = size / 8;
    fuzz::require(bool(bytes.resize(8 * words + 24, "part")), "memory for its bytes");
    const char head[] = "PLUSPART\1\0\0\0\0\0\0";
    std::memcpy(bytes.data(), head, 16);
    std::memcpy(bytes.data() + 16, data, 8 * words);
    Digest digest;
    digest.bytes(bytes.data(), 8 * words + 16);
    const std::uint64_t value = digest.value();
    for (std::size_t i = 0; i < 8; ++i) bytes[8 * words + 16 + i] = char(value >> (8 * i) & 255);
    Part out;
    const Status status = decode_part("p.part", bytes.span(), out);
    if (!status) {
        fuzz::require(status.message.find('\n') == std::string::npos, "one line");
        return 0;
    }
    Buffer<char> again;
    fuzz::require(bool(encode_part(out, again)), "what was read can be written");
    fuzz::require(again.size() == bytes.size(), "and is as long");
    std::vector<Part> parts;
    parts.push_back(std::move(out));
    (void)check_parts(false, parts);
    return 0;
}
