// SPDX-License-Identifier: Apache-2.0
// FNV-1a 64 over little-endian numbers: for lots and for keys of random numbers, nothing else.
// Another function would draw other particles, and so make other pictures.
// in: numbers -> out: 64 bits; lots below 2^32. Basis 0xcbf29ce484222325, prime 0x100000001b3.
#pragma once
#include <cstdint>
#include <cstring>

#include "src/base/span.h"

namespace pileus {

class Fnv1a64 {
public:
    void byte(std::uint8_t v) { state_ = (state_ ^ v) * 0x100000001b3ull; }
    void u32(std::uint32_t v) {
        for (int i = 0; i < 4; ++i) byte(static_cast<std::uint8_t>(v >> (8 * i)));
    }
    void u64(std::uint64_t v) {
        u32(static_cast<std::uint32_t>(v));
        u32(static_cast<std::uint32_t>(v >> 32));
    }
    void floats(Span<const float> values) {
        for (const float v : values) {
            std::uint32_t bits;
            std::memcpy(&bits, &v, 4);
            u32(bits);
        }
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

/// FNV-1a 64 of a text.
inline std::uint64_t fnv1a64(Span<const char> text) {
    Fnv1a64 all;
    for (const char c : text) all.byte(static_cast<std::uint8_t>(c));
    return all.value();
}

/// A number below 2^32 to draw lots by, the same for the same numbers.
inline std::uint64_t lot_of(std::uint64_t v) {
    // High bits of FNV-1a alone are well mixed.
    v ^= v >> 32;
    v *= 0xd6e8feb86659fd93ull;
    return v >> 32;
}

}  // namespace pileus
