// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: the same (key, counter) gives the same bits everywhere.
// in: key = (seed, stream), counter = (photon or pixel, draw) -> out: 64 bits per call.
// Threefry2x32-20: Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3".
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {

/// A key for one stream of one seed, so that streams never share counters.
struct Key {
    std::uint32_t k0, k1;
};

inline namespace PILEUS_ISA {

template <class UU>
struct Words {
    UU a, b;
};

template <int R, class UU>
PILEUS_FN UU rotate_left(UU v) {
    return (v << R) | (v >> (32 - R));
}

/// Threefry2x32 with 20 rounds. Keys are scalars, counters may be lanes.
template <class UU>
PILEUS_FN Words<UU> threefry(std::uint32_t k0, std::uint32_t k1, UU c0, UU c1) {
    const std::uint32_t k2 = 0x1BD11BDAu ^ k0 ^ k1;
    UU x = c0 + k0, y = c1 + k1;
#define PILEUS_FOUR(r0, r1, r2, r3)               \
    x = x + y, y = rotate_left<r0>(y), y = y ^ x; \
    x = x + y, y = rotate_left<r1>(y), y = y ^ x; \
    x = x + y, y = rotate_left<r2>(y), y = y ^ x; \
    x = x + y, y = rotate_left<r3>(y), y = y ^ x
    PILEUS_FOUR(13, 15, 26, 6);
    x = x + k1, y = y + (k2 + 1u);
    PILEUS_FOUR(17, 29, 16, 24);
    x = x + k2, y = y + (k0 + 2u);
    PILEUS_FOUR(13, 15, 26, 6);
    x = x + k0, y = y + (k1 + 3u);
    PILEUS_FOUR(17, 29, 16, 24);
    x = x + k1, y = y + (k2 + 4u);
    PILEUS_FOUR(13, 15, 26, 6);
    x = x + k2, y = y + (k0 + 5u);
#undef PILEUS_FOUR
    return {x, y};
}

/// Uniform in [0, 1): the top 24 bits times 2^-24, exact.
template <class UU>
PILEUS_FN auto uniform(UU word) {
    return to_float(reinterpret<I_of<UU>>(word >> 8)) * 0x1p-24f;
}

/// Uniform in (0, 1): the top 23 bits plus a half, exact; never 0, never 1 (docs/testing.md S51).
template <class UU>
PILEUS_FN auto uniform_open(UU word) {
    return to_float(reinterpret<I_of<UU>>((word >> 9) * 2u + 1u)) * 0x1p-24f;
}

/// The key of (seed, stream, high half of the index).
PILEUS_FN Key make_key(std::uint64_t seed, std::uint32_t stream, std::uint32_t high) {
    const Words<std::uint32_t> w =
        threefry(std::uint32_t(seed), std::uint32_t(seed >> 32), stream, high);
    return {w.a, w.b};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
