// SPDX-License-Identifier: Apache-2.0
// The march of light from lamps, compiled once per instruction set, apart from others.
// in: the kernel templates -> out: one exported table, named after the instruction set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/raymarch/lamp_march.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_LAMPS(isa) PILEUS_JOIN(lamp_kernel_, isa)

namespace pileus {
namespace {

void depth_kernel(const LampMarchParams& k, const LampMarchBuffers& b, std::uint32_t begin,
                  std::uint32_t end) {
    lamp_depth_rows<PILEUS_WIDTH>(k, b, begin, end);
}
void march_kernel(const LampMarchParams& k, const LampMarchBuffers& b, std::uint32_t begin,
                  std::uint32_t end) {
    lamp_march_rows<PILEUS_WIDTH>(k, b, begin, end);
}

}  // namespace

extern const LampKernels PILEUS_LAMPS(PILEUS_ISA);
const LampKernels PILEUS_LAMPS(PILEUS_ISA) = {depth_kernel, march_kernel};

}  // namespace pileus
