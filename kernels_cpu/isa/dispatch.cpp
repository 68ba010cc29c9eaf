// SPDX-License-Identifier: Apache-2.0
// Chooses the kernel table: the widest this machine runs, or the one asked for by name.
// in: PILEUS_HAVE_<ISA> from the build, the processor's word -> out: a table.
// Intel, Software Developer's Manual, CPUID leaves 1 and 7, XGETBV
#if defined(PILEUS_HAVE_AVX2) || defined(PILEUS_HAVE_AVX512)
#define PILEUS_ASKS_PROCESSOR 1
#include <cpuid.h>
#endif

#include "kernels_cpu/isa/kernels.h"

namespace pileus {

#ifdef PILEUS_HAVE_SCALAR
extern const KernelTable kernel_table_scalar;
#endif
#ifdef PILEUS_HAVE_VEC4
extern const KernelTable kernel_table_vec4;
#endif
#ifdef PILEUS_HAVE_SSE2
extern const KernelTable kernel_table_sse2;
#endif
#ifdef PILEUS_HAVE_AVX2
extern const KernelTable kernel_table_avx2;
#endif
#ifdef PILEUS_HAVE_AVX512
extern const KernelTable kernel_table_avx512;
#endif

namespace {

bool same(const char* a, const char* b) {
    for (; *a != '\0' && *a == *b; ++a, ++b) {
    }
    return *a == *b;
}

#ifdef PILEUS_ASKS_PROCESSOR
// Not every compiler's runtime tells what the processor and its system run.

/// Registers that the system keeps for each thread, XCR0; 0: it keeps none beyond SSE's.
std::uint32_t kept_registers() {
    constexpr unsigned kOsSaves = 1u << 27;
    unsigned a = 0, b = 0, c = 0, d = 0;
    if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & kOsSaves) == 0) return 0;
    std::uint32_t low = 0, high = 0;
    asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

bool runs_set(std::uint32_t registers, unsigned features) {
    unsigned a = 0, b = 0, c = 0, d = 0;
    return (kept_registers() & registers) == registers &&
           __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & features) == features;
}

[[maybe_unused]] bool runs_avx2() { return runs_set(0x6, 1u << 5); }
/// F, DQ, BW and VL.
[[maybe_unused]] bool runs_avx512() {
    return runs_set(0xe6, 1u << 16 | 1u << 17 | 1u << 30 | 1u << 31);
}
#endif

}  // namespace

const KernelTable* kernel_table_at(int i) {
    const KernelTable* runnable[6] = {};
    int count = 0;
#ifdef PILEUS_HAVE_SCALAR
    runnable[count++] = &kernel_table_scalar;
#endif
#ifdef PILEUS_HAVE_VEC4
    runnable[count++] = &kernel_table_vec4;
#endif
#ifdef PILEUS_HAVE_SSE2
    runnable[count++] = &kernel_table_sse2;
#endif
#ifdef PILEUS_HAVE_AVX2
    if (runs_avx2()) runnable[count++] = &kernel_table_avx2;
#endif
#ifdef PILEUS_HAVE_AVX512
    if (runs_avx512()) runnable[count++] = &kernel_table_avx512;
#endif
    return i >= 0 && i < count ? runnable[i] : nullptr;
}

const KernelTable* kernel_table(const char* name) {
    const KernelTable* chosen = nullptr;
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i)
        if (name == nullptr || same(name, table->name)) chosen = table;
    return chosen;
}

std::uint64_t expected_self_test() { return 0x10ad2191dbe6071bull; }

}  // namespace pileus
