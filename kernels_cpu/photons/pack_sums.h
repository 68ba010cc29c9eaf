// SPDX-License-Identifier: Apache-2.0
// Packs whole numbers to twelve binary digits and one power of two for each set of them.
// in: sums of photons, one block per thread -> out: packed sets, and the total of many such.
// docs/collectors.md, "The ring of generations"
#pragma once
#include "kernels_cpu/core/lanes.h"
#include "kernels_cpu/photons/pack_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

constexpr int kPackedDigits = 11;  ///< beside the sign
constexpr int kMaxPacked = 96;     ///< numbers of a set

/// Loops over so many numbers are known to the compiler where N > 0.
template <int N>
PILEUS_FN int count_of(int numbers) {
    return N > 0 ? N : numbers;
}

/// The numbers of a packed set, in units of 2^(what is returned).
template <int N>
PILEUS_FN int unpack_set(const std::uint8_t* packed, int numbers, std::int32_t* q) {
    const int n = count_of<N>(numbers), half = (n + 1) / 2;
    const std::uint8_t* low = packed + n;
    for (int i = 0; i < half; ++i) q[i] = std::int32_t(std::int8_t(packed[i])) * 16 + (low[i] & 15);
    for (int i = half; i < n; ++i)
        q[i] = std::int32_t(std::int8_t(packed[i])) * 16 + (low[i - half] >> 4);
    return low[half];
}

/// total += sign * the numbers, in units of 2^coarser; halves are rounded away from zero, number by
/// number, so that a set is taken out by what it brought.
template <int N>
PILEUS_FN void add_set(const std::uint8_t* packed, int numbers, int coarser, std::int32_t sign,
                       std::int64_t* total) {
    const int n = count_of<N>(numbers);
    std::int32_t q[N > 0 ? N : kMaxPacked];
    const int up = unpack_set<N>(packed, numbers, q) - coarser;
    if (up < 0) {
        const int down = -up < 20 ? -up : 20;
        const std::int32_t half = std::int32_t(1) << (down - 1);
        for (int i = 0; i < n; ++i) {
            const std::int32_t size = ((q[i] < 0 ? -q[i] : q[i]) + half) >> down;
            q[i] = q[i] < 0 ? -size : size;
        }
    }
    const int left = up > 0 ? up : 0;
    for (int i = 0; i < n; ++i)
        total[i] += std::int64_t(std::uint64_t(std::int64_t(q[i] * sign)) << left);
}

/// Twelve digits of each of `numbers` of up to `length` digits; returns the power of two.
template <int N>
PILEUS_FN int round_set(const std::int64_t* v, int numbers, int length, double scale,
                        std::int32_t* q) {
    const int n = count_of<N>(numbers);
    const int power = length > kPackedDigits ? length - kPackedDigits : 0;
    const double factor = scale / double(std::uint64_t(1) << power);
    constexpr std::int32_t kMax = (1 << kPackedDigits) - 1;
    const auto rounded = [&](double x) {
        const std::int32_t whole = std::int32_t(x + (x < 0 ? -0.5 : 0.5));
        return whole > kMax ? kMax : (whole < -kMax ? -kMax : whole);
    };
    // Machines turn 32 bits into doubles side by side; the double is the same.
    if (length < 32)
        for (int i = 0; i < n; ++i) q[i] = rounded(double(std::int32_t(v[i])) * factor);
    else
        for (int i = 0; i < n; ++i) q[i] = rounded(double(v[i]) * factor);
    return power;
}

/// Packs one set that begins at `sums`, and leaves zeros there. `total`, or null, takes the numbers
/// as they were.
template <int N>
PILEUS_FN void pack_set(const PackParams& k, std::int64_t* sums, std::uint8_t* packed,
                        std::int64_t* total) {
    const int n = count_of<N>(k.numbers), half = (n + 1) / 2;
    std::int64_t v[N > 0 ? N : kMaxPacked];
    std::int32_t q[(N > 0 ? N : kMaxPacked) + 1];
    for (int i = 0; i < n; ++i) v[i] = sums[i], sums[i] = 0;
    for (int b = 1; b < k.blocks; ++b) {
        std::int64_t* more = sums + std::uint64_t(b) * k.block_stride;
        for (int i = 0; i < n; ++i) v[i] += more[i], more[i] = 0;
    }
    if (total != nullptr)
        for (int i = 0; i < n; ++i) total[i] += v[i];
    // As long as the longest: of a negative number that of its complement.
    std::uint64_t digits = 0;
    for (int i = 0; i < n; ++i) digits |= std::uint64_t(v[i] ^ (v[i] >> 63));
    const int length = digits == 0 ? 0 : 64 - __builtin_clzll(digits);
    const int power = round_set<N>(v, n, length, k.scale, q);
    q[n] = 0;
    std::uint8_t* low = packed + n;
    for (int i = 0; i < n; ++i) packed[i] = std::uint8_t(q[i] >> 4);
    for (int i = 0; i < half; ++i) low[i] = std::uint8_t((q[i] & 15) | ((q[half + i] & 15) << 4));
    low[half] = std::uint8_t(power);
}

template <int N>
PILEUS_FN void pack_sets_of(const PackParams& k, const PackBuffers& b, std::uint64_t begin,
                            std::uint64_t end) {
    const std::uint64_t bytes = packed_bytes(std::uint64_t(k.numbers));
    for (std::uint64_t s = begin; s < end; ++s) {
        std::uint8_t* packed = b.packed + s * bytes;
        const std::uint64_t first = s * std::uint64_t(k.numbers);
        std::int64_t* total = b.total != nullptr ? b.total + first : nullptr;
        const bool follows = total != nullptr && !k.exact;
        if (follows && k.replaces) add_set<N>(packed, k.numbers, k.old_coarser, -1, total);
        pack_set<N>(k, b.sums + first, packed, k.exact ? total : nullptr);
        if (follows) add_set<N>(packed, k.numbers, k.coarser, 1, total);
    }
}

template <int N>
PILEUS_FN void add_sets_of(const PackParams& k, const PackBuffers& b, std::uint64_t begin,
                           std::uint64_t end) {
    const std::uint64_t bytes = packed_bytes(std::uint64_t(k.numbers));
    for (std::uint64_t s = begin; s < end; ++s)
        add_set<N>(b.packed + s * bytes, k.numbers, k.coarser, 1,
                   b.total + s * std::uint64_t(k.numbers));
}

/// Four bands; with eight degrees about the sun's axis; and with light scattered once. Compilers
/// widen the loops over a set's numbers.
template <int W>
PILEUS_FN void pack_sets(const PackParams& k, const PackBuffers& b, std::uint64_t begin,
                         std::uint64_t end) {
    if (k.numbers == 16) return pack_sets_of<16>(k, b, begin, end);
    if (k.numbers == 24) return pack_sets_of<24>(k, b, begin, end);
    if (k.numbers == 25) return pack_sets_of<25>(k, b, begin, end);
    pack_sets_of<0>(k, b, begin, end);
}

template <int W>
PILEUS_FN void add_sets(const PackParams& k, const PackBuffers& b, std::uint64_t begin,
                        std::uint64_t end) {
    if (k.numbers == 16) return add_sets_of<16>(k, b, begin, end);
    if (k.numbers == 24) return add_sets_of<24>(k, b, begin, end);
    if (k.numbers == 25) return add_sets_of<25>(k, b, begin, end);
    add_sets_of<0>(k, b, begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
