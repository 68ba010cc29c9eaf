// SPDX-License-Identifier: Apache-2.0
// Moves chosen lanes close together, so that rare events fill whole vectors.
// in: lanes and one bit for each -> out: the chosen ones side by side in an array, in lane order.
// docs/methods.md 3, "Queues".
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

#if defined(__AVX2__)
/// For each set of eight lanes the lanes in it, first to last, one byte each.
struct PackOrder {
    std::uint64_t of[256];
};
constexpr PackOrder make_pack_order() {
    PackOrder order{};
    for (std::uint32_t set = 0; set < 256; ++set) {
        int place = 0;
        for (std::uint32_t i = 0; i < 8; ++i)
            if ((set >> i) & 1u) order.of[set] |= std::uint64_t{i} << (8 * place++);
    }
    return order;
}
constexpr PackOrder kPackOrder = make_pack_order();
#endif

/// Writes the lanes of `v` named by `bits` to at[0], at[1] ... There must be room for W numbers.
template <class S, class T>
PILEUS_FN void pack(S* at, T v, std::uint32_t bits) {
    static_assert(sizeof(S) == 4, "lanes of 32 bits");
    [[maybe_unused]] constexpr int W = width_of<T>;
#if defined(__AVX512F__)
    // The form that writes memory itself is slow on some processors.
    if constexpr (W == 16) {
        _mm512_storeu_si512(at, _mm512_maskz_compress_epi32(__mmask16(bits), (__m512i)v));
        return;
    }
#endif
#if defined(__AVX2__)
    if constexpr (W == 8) {
        const __m128i order = _mm_cvtsi64_si128(std::int64_t(kPackOrder.of[bits]));
        _mm256_storeu_si256((__m256i*)at,
                            _mm256_permutevar8x32_epi32((__m256i)v, _mm256_cvtepu8_epi32(order)));
        return;
    }
#endif
    for (; bits != 0; bits &= bits - 1) *at++ = S(lane(v, lowest_bit(bits)));
}

/// W numbers from at[0], at[1] ...; the array need not be aligned.
template <class T, class S>
PILEUS_FN T load(const S* at) {
    static_assert(sizeof(S) == 4, "lanes of 32 bits");
    T v;
    __builtin_memcpy(&v, at, sizeof v);
    return v;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
