// SPDX-License-Identifier: Apache-2.0
// The verbs that deserve an instruction: any, sqrt, gather, stream. Elsewhere a loop over lanes.
// in: lanes -> out: lanes, bits. Every form gives the same bits: IEEE square root, exact loads.
// docs/architecture.md, "Kernels: written once".
#pragma once
#include "kernels_cpu/core/lanes.h"

// Device code has no instructions of the host's processor.
#if (defined(__x86_64__) || defined(__i386__)) && !defined(__CUDACC__)
#include <immintrin.h>
#if defined(__SSE2__)
#define PILEUS_SSE2
#endif
#if defined(__AVX__)
#define PILEUS_AVX
#endif
#if defined(__AVX2__)
#define PILEUS_AVX2
#endif
#if defined(__AVX512F__)
#define PILEUS_AVX512
#endif
#endif
#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace pileus {
inline namespace PILEUS_ISA {

template <class Mask>
PILEUS_FN bool any(Mask m) {
    if constexpr (width_of<Mask> == 1) {
        return m;
    } else {
#if defined(PILEUS_AVX512)
        if constexpr (sizeof(Mask) == 64)
            return _mm512_test_epi32_mask((__m512i)m, (__m512i)m) != 0;
#endif
#if defined(PILEUS_AVX)
        if constexpr (sizeof(Mask) == 32) return _mm256_movemask_ps((__m256)m) != 0;
#endif
#if defined(PILEUS_SSE2)
        if constexpr (sizeof(Mask) == 16) return _mm_movemask_ps((__m128)m) != 0;
#endif
#if defined(__wasm_simd128__)
        if constexpr (sizeof(Mask) == 16) return wasm_v128_any_true((v128_t)m);
#endif
        std::int32_t r = 0;
        for (int i = 0; i < width_of<Mask>; ++i) r |= m[i];
        return r != 0;
    }
}

/// One bit per lane, lane 0 lowest.
template <class Mask>
PILEUS_FN std::uint32_t bits_of(Mask m) {
    if constexpr (width_of<Mask> == 1) {
        return m ? 1u : 0u;
    } else {
#if defined(PILEUS_AVX512)
        if constexpr (sizeof(Mask) == 64) return _mm512_test_epi32_mask((__m512i)m, (__m512i)m);
#endif
#if defined(PILEUS_AVX)
        if constexpr (sizeof(Mask) == 32) return std::uint32_t(_mm256_movemask_ps((__m256)m));
#endif
#if defined(PILEUS_SSE2)
        if constexpr (sizeof(Mask) == 16) return std::uint32_t(_mm_movemask_ps((__m128)m));
#endif
#if defined(__wasm_simd128__)
        if constexpr (sizeof(Mask) == 16) return wasm_i32x4_bitmask((v128_t)m);
#endif
        std::uint32_t r = 0;
        for (int i = 0; i < width_of<Mask>; ++i) r |= m[i] ? 1u << i : 0u;
        return r;
    }
}

/// Number of set bits among the 16 lowest; the builtin calls a library where there is no
/// instruction.
PILEUS_FN std::int32_t count_bits(std::uint32_t v) {
#if defined(__POPCNT__)
    return __builtin_popcount(v & 0xffffu);
#else
    v = v - ((v >> 1) & 0x5555u);
    v = (v & 0x3333u) + ((v >> 2) & 0x3333u);
    v = (v + (v >> 4)) & 0x0f0fu;
    return std::int32_t((v + (v >> 8)) & 0x1fu);
#endif
}

/// Number of the lowest set bit; v is not 0.
PILEUS_FN int lowest_bit(std::uint32_t v) {
#if defined(__CUDA_ARCH__)
    return __ffs(int(v)) - 1;
#else
    return __builtin_ctz(v);
#endif
}

/// Ask for the memory at `at`, so that it comes while others compute; changes nothing.
PILEUS_FN void prefetch_(const void* at) {
#if defined(__CUDA_ARCH__)
    (void)at;  // other threads compute meanwhile
#else
    __builtin_prefetch(at);
#endif
}
/// The same for memory that will be written.
PILEUS_FN void prefetch_to_write_(const void* at) {
#if defined(__CUDA_ARCH__)
    (void)at;
#else
    __builtin_prefetch(at, 1);
#endif
}

/// Stores past the caches at a place aligned to sizeof(T), for what is not read again soon.
template <class T>
PILEUS_FN void stream_(float* to, T v) {
#if defined(PILEUS_AVX512)
    if constexpr (sizeof(T) == 64) return _mm512_stream_ps(to, (__m512)v);
#endif
#if defined(PILEUS_AVX)
    if constexpr (sizeof(T) == 32) return _mm256_stream_ps(to, (__m256)v);
#endif
#if defined(PILEUS_SSE2)
    if constexpr (sizeof(T) == 16) return _mm_stream_ps(to, (__m128)v);
#endif
    __builtin_memcpy(to, &v, sizeof(T));
}
/// Makes what was streamed visible to other threads before anything that follows.
PILEUS_FN void end_stream() {
#if defined(PILEUS_SSE2)
    _mm_sfence();
#endif
}

template <class T>
PILEUS_FN T sqrt_(T v) {
    if constexpr (width_of<T> == 1) {
        return __builtin_sqrtf(v);
    } else {
#if defined(PILEUS_AVX512)
        if constexpr (sizeof(T) == 64) return (T)_mm512_maskz_sqrt_ps(0xffff, (__m512)v);
#endif
#if defined(PILEUS_AVX)
        if constexpr (sizeof(T) == 32) return (T)_mm256_sqrt_ps((__m256)v);
#endif
#if defined(PILEUS_SSE2)
        if constexpr (sizeof(T) == 16) return (T)_mm_sqrt_ps((__m128)v);
#endif
#if defined(__wasm_simd128__)
        if constexpr (sizeof(T) == 16) return (T)wasm_f32x4_sqrt((v128_t)v);
#endif
        T r{};
        for (int i = 0; i < width_of<T>; ++i) r[i] = __builtin_sqrtf(v[i]);
        return r;
    }
}

/// base[index] per lane; every index must be readable.
template <class Index>
PILEUS_FN auto gather(const float* base, Index index) {
    if constexpr (width_of<Index> == 1) {
        return base[index];
    } else {
        using T = F_of<Index>;
#if defined(PILEUS_AVX512)
        if constexpr (sizeof(T) == 64)
            return (T)_mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff, (__m512i)index, base,
                                               4);
#endif
#if defined(PILEUS_AVX2)
        if constexpr (sizeof(T) == 32) return (T)_mm256_i32gather_ps(base, (__m256i)index, 4);
#endif
        T r{};
        for (int i = 0; i < width_of<Index>; ++i) r[i] = base[index[i]];
        return r;
    }
}
template <class Index>
PILEUS_FN auto gather(const std::int32_t* base, Index index) {
    if constexpr (width_of<Index> == 1) {
        return base[index];
    } else {
        using T = I_of<Index>;
#if defined(PILEUS_AVX512)
        if constexpr (sizeof(T) == 64)
            return (T)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, (__m512i)index,
                                                  base, 4);
#endif
#if defined(PILEUS_AVX2)
        if constexpr (sizeof(T) == 32)
            return (T)_mm256_i32gather_epi32((const int*)base, (__m256i)index, 4);
#endif
        T r{};
        for (int i = 0; i < width_of<Index>; ++i) r[i] = base[index[i]];
        return r;
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
