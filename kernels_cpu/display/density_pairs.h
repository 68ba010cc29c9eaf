// SPDX-License-Identifier: Apache-2.0
// A density between grid points from four loads of two neighbours in place of eight of one.
// in: a grid, corners of places in it -> out: what interpolate() gives, the same bits.
// docs/performance.md, "A march's look-ups"
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/media/medium.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Widths whose lanes are gathered two numbers at a time.
#if defined(PILEUS_AVX512)
template <int W>
constexpr bool kGathersPairs = W == 16;
#elif defined(PILEUS_AVX2)
template <int W>
constexpr bool kGathersPairs = W == 8;
#else
template <int W>
constexpr bool kGathersPairs = false;
#endif

/// base[index] and base[index + 1] per lane.
template <class T>
PILEUS_FN void gather_pairs(const float* base, I_of<T> index, T& first, T& second) {
#if defined(PILEUS_AVX512)
    // Not by the headers' own functions, some of which warn of what they leave unset.
    const auto half = [&](int from) {
        F<8> numbers;
        __builtin_memcpy(&numbers, reinterpret_cast<const char*>(&index) + 4 * from,
                         sizeof numbers);
        return _mm512_mask_i32gather_epi64(_mm512_setzero_si512(), 0xff, (__m256i)numbers, base, 4);
    };
    const T low = (T)half(0), high = (T)half(8);
    first = __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26,
                                    28, 30);
    second = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27,
                                     29, 31);
#elif defined(PILEUS_AVX2)
    const __m256i i = (__m256i)index;
    const auto* from = reinterpret_cast<const long long*>(base);
    const __m256 low = (__m256)_mm256_i32gather_epi64(from, _mm256_castsi256_si128(i), 4);
    const __m256 high = (__m256)_mm256_i32gather_epi64(from, _mm256_extracti128_si256(i, 1), 4);
    const auto lanes = [](__m256 mixed) {
        return (T)_mm256_permute4x64_epi64((__m256i)mixed, 0xd8);
    };
    first = lanes(_mm256_shuffle_ps(low, high, 0x88));
    second = lanes(_mm256_shuffle_ps(low, high, 0xdd));
#else
    first = gather(base, index), second = gather(base, index + 1);
#endif
}

/// Two rows of a grid, at least two cells wide and without periods, mixed by fx and fy.
template <class T>
PILEUS_FN T row_pairs(const float* grid, const Corners<T>& c, I_of<T> y0, I_of<T> y1,
                      std::int32_t size) {
    using II = I_of<T>;
    const auto mix = [](T a, T b, T f) { return a + (b - a) * f; };
    // The last cell has no neighbour: both are the second of the pair before it.
    const auto last = c.x0 > size - 2;
    const II left = min_(c.x0, all<II>(size - 2));
    const auto row = [&](II yz) {
        T a, b;
        gather_pairs(grid, yz + left, a, b);
        return mix(select(last, b, a), b, c.fx);
    };
    return mix(row(y0), row(y1), c.fy);
}

/// interpolate(grid, c) likewise.
template <class T>
PILEUS_FN T interpolate_pairs(const float* grid, const Corners<T>& c, std::int32_t size) {
    const T low = row_pairs(grid, c, c.z0 + c.y0, c.z0 + c.y1, size);
    const T high = row_pairs(grid, c, c.z1 + c.y0, c.z1 + c.y1, size);
    return low + (high - low) * c.fz;
}

/// read_density of a medium's grid.
template <bool Constant, class T>
PILEUS_FN T density_at(const MediumView& m, const Corners<T>& c) {
    if constexpr (!Constant && kGathersPairs<width_of<T>>)
        if (m.periodic == 0 && m.size[0] > 1) return interpolate_pairs(m.density, c, m.size[0]);
    return read_density<Constant>(m.density, c);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
