// SPDX-License-Identifier: Apache-2.0
// Chooses the kernel table: the widest this machine runs, or the one asked for by name.
// in: PILEUS_HAVE_<ISA> from the build, the processor's word -> out: a table.
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
    if (__builtin_cpu_supports("avx2")) runnable[count++] = &kernel_table_avx2;
#endif
#ifdef PILEUS_HAVE_AVX512
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        runnable[count++] = &kernel_table_avx512;
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
