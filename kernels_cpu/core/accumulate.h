// SPDX-License-Identifier: Apache-2.0
// Adds to a sum of integers that belongs to one thread alone, or to all of them.
// in: a place, a number, whether others add there too -> out: the same sum in any order.
// docs/determinism.md; docs/collectors.md, "Accumulation": what each way costs.
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {

/// Whether this machine adds 64 bits in one piece; where it does not, one thread alone may use
/// shared sums.
#if defined(__CUDA_ARCH__) || __GCC_ATOMIC_LLONG_LOCK_FREE == 2
constexpr bool kSharesSums = true;
#else
constexpr bool kSharesSums = false;
#endif

inline namespace PILEUS_ISA {

/// An integer where an atomic instruction may reach it: 32-bit ABIs align less.
typedef std::int64_t SharedSum __attribute__((aligned(8)));

/// *at += v; `shared`: other threads may add there at the same time. Nothing is ordered by it.
PILEUS_FN void add_sum(std::int64_t* at, std::int64_t v, bool shared) {
#if defined(__CUDA_ARCH__)
    if (shared) {
        atomicAdd(reinterpret_cast<unsigned long long*>(at), static_cast<unsigned long long>(v));
        return;
    }
#elif __GCC_ATOMIC_LLONG_LOCK_FREE == 2
    if (shared) {
        __atomic_fetch_add(reinterpret_cast<SharedSum*>(at), v, __ATOMIC_RELAXED);
        return;
    }
#else
    (void)shared;
#endif
    *at += v;
}

/// Adds lane `i` of `count` numbers to at[0 ... count - 1].
template <class II>
PILEUS_FN void add_sums(std::int64_t* at, const II* numbers, int i, int count, bool shared) {
    if (shared)
        for (int c = 0; c < count; ++c) add_sum(at + c, lane(numbers[c], i), true);
    else
        for (int c = 0; c < count; ++c) add_sum(at + c, lane(numbers[c], i), false);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
