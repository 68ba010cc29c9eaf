// SPDX-License-Identifier: Apache-2.0
// The raymarch, compiled once per instruction set, apart from isa.cpp so that both build at
// once. in: the kernel templates -> out: one exported function, named after the instruction set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/raymarch/raymarch.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_RAYMARCH(isa) PILEUS_JOIN(raymarch_kernel_, isa)

namespace pileus {

void PILEUS_RAYMARCH(PILEUS_ISA)(const RaymarchParams&, const RaymarchBuffers&, std::uint32_t,
                                 std::uint32_t);
void PILEUS_RAYMARCH(PILEUS_ISA)(const RaymarchParams& k, const RaymarchBuffers& b,
                                 std::uint32_t begin, std::uint32_t end) {
    raymarch_rows<PILEUS_WIDTH>(k, b, begin, end);
}

}  // namespace pileus
