// SPDX-License-Identifier: Apache-2.0
// Numbers for made pictures and grids: the same on every machine.
// in: a place, a seed -> out: a number in [0, 1).
// docs/testing.md
#pragma once
#include <cstddef>
#include <cstdint>

namespace pileus::test {

/// A number in [0, 1) for each place.
inline float number(std::size_t i, std::uint32_t seed) {
    std::uint32_t h = std::uint32_t(i) * 2654435761u + seed * 40503u + 12345u;
    h ^= h >> 15, h *= 2246822519u, h ^= h >> 13, h *= 3266489917u, h ^= h >> 16;
    return float(h >> 8) * (1.0f / 16777216);
}

}  // namespace pileus::test
