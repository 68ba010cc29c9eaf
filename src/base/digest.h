// SPDX-License-Identifier: Apache-2.0
// XXH3 64 over values in canonical (little-endian) byte order, the same on every machine.
// in: numbers -> out: 64 bits, printed as 16 hex digits, the highest first (XXH64's canonical
// form). Collet, xxHash specification 0.8; random choices have src/base/fnv1a64.h.
#pragma once
#include <cstddef>
#include <cstdint>
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

/// Whole arrays go at the speed of memory, one number at a time takes some 6 ns.
class Digest {
public:
    Digest();

    void bytes(const void* data, std::size_t count);  ///< as they are
    void text(const std::string& letters) { bytes(letters.data(), letters.size()); }
    void byte(std::uint8_t v) { bytes(&v, 1); }
    void u32(std::uint32_t v) { numbers(&v, 1, sizeof v); }
    void u64(std::uint64_t v) { numbers(&v, 1, sizeof v); }
    void f32(float v) { numbers(&v, 1, sizeof v); }
    void words(Span<const std::uint32_t> v) { numbers(v.data, v.size, 4); }
    void words(Span<const std::int32_t> v) { numbers(v.data, v.size, 4); }
    void floats(Span<const float> v) { numbers(v.data, v.size, 4); }
    void doubles(Span<const double> v) { numbers(v.data, v.size, 8); }
    void integers(Span<const std::int64_t> v) { numbers(v.data, v.size, 8); }
    std::uint64_t value() const;
    std::string hex() const { return hex_text(value()); }

private:
    /// `count` numbers of `width` bytes each.
    void numbers(const void* data, std::size_t count, std::size_t width);

    alignas(64) unsigned char state_[576];  // XXH3_state_t, which one file alone knows
};

}  // namespace pileus
