// SPDX-License-Identifier: Apache-2.0
// Rays against solid meshes, compiled once per instruction set, apart from isa.cpp so that both
// build at once. in: the kernel templates -> out: exported functions, named after the instruction
// set. docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing
// leaks.
#include "kernels_cpu/solids/solid_rows.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_SOLIDS(isa) PILEUS_JOIN(solid_rows_, isa)

namespace pileus {

void PILEUS_SOLIDS(PILEUS_ISA)(const SolidRowsParams&, const BackgroundBuffers&, std::uint32_t,
                               std::uint32_t);
void PILEUS_SOLIDS(PILEUS_ISA)(const SolidRowsParams& k, const BackgroundBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    if (b.shadow != nullptr) return shadow_of_rows<PILEUS_WIDTH>(k, b, begin, end);
    solid_rows<PILEUS_WIDTH>(k, b, begin, end);
}

}  // namespace pileus
