// SPDX-License-Identifier: Apache-2.0
// Packing of sums, compiled once per instruction set, apart from isa.cpp so that both build at
// once. in: the kernel templates -> out: one exported table, named after the set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/photons/pack_sums.h"

#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_PACK(isa) PILEUS_JOIN(pack_kernel_, isa)

namespace pileus {
namespace {

void pack_kernel(const PackParams& k, const PackBuffers& b, std::uint64_t begin,
                 std::uint64_t end) {
    pack_sets(k, b, begin, end);
}
void add_kernel(const PackParams& k, const PackBuffers& b, std::uint64_t begin, std::uint64_t end) {
    add_sets(k, b, begin, end);
}

}  // namespace

extern const PackKernels PILEUS_PACK(PILEUS_ISA);
const PackKernels PILEUS_PACK(PILEUS_ISA) = {pack_kernel, add_kernel};

}  // namespace pileus
