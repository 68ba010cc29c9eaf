// SPDX-License-Identifier: Apache-2.0
// FNV-1a 64 over values in canonical (little-endian) byte order, the same on every machine.
// in: numbers -> out: 64 bits, printed as 16 hex digits.
// Fowler, Noll, Vo: offset basis 0xcbf29ce484222325, prime 0x100000001b3.
#pragma once
#include <cstdint>
#include <cstring>
#include <string>

#include "src/base/span.h"

namespace pileus {

/// 16 hex digits.
inline std::string hex_text(std::uint64_t v) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text(16, '0');
    for (int i = 0; i < 16; ++i) text[std::size_t(i)] = digits[(v >> (60 - 4 * i)) & 15];
    return text;
}

class Digest {
public:
    void byte(std::uint8_t b) { state_ = (state_ ^ b) * 0x100000001b3ull; }
    void u32(std::uint32_t v) {
        for (int i = 0; i < 4; ++i) byte(static_cast<std::uint8_t>(v >> (8 * i)));
    }
    void u64(std::uint64_t v) {
        u32(static_cast<std::uint32_t>(v));
        u32(static_cast<std::uint32_t>(v >> 32));
    }
    void f32(float v) {
        std::uint32_t bits;
        std::memcpy(&bits, &v, 4);
        u32(bits);
    }
    void floats(Span<const float> values) {
        for (float v : values) f32(v);
    }
    void integers(Span<const std::int64_t> values) {
        for (std::int64_t v : values) u64(static_cast<std::uint64_t>(v));
    }
    std::uint64_t value() const { return state_; }
    std::string hex() const { return hex_text(state_); }

private:
    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

/// A number below 2^32 to draw lots by, the same for the same digest.
inline std::uint64_t lot_of(std::uint64_t v) {
    // High bits of the digest alone are well mixed.
    v ^= v >> 32;
    v *= 0xd6e8feb86659fd93ull;
    return v >> 32;
}
inline std::uint64_t lot_of(const Digest& digest) { return lot_of(digest.value()); }

}  // namespace pileus
