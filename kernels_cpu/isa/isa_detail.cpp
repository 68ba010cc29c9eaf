// SPDX-License-Identifier: Apache-2.0
// Marches through media with detail, compiled once per instruction set, apart from the others so
// that scenes without it pay nothing.
// in: the kernel templates -> out: a table of functions, named after the instruction set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/display/march.h"
#include "kernels_cpu/raymarch/raymarch_detail.h"
#include "kernels_cpu/raymarch/raymarch_detail_params.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_DETAIL(isa) PILEUS_JOIN(detail_kernel_, isa)

namespace pileus {
namespace {

void shadow_kernel(const ShadowParams& k, const ShadowBuffers& b, std::uint32_t begin,
                   std::uint32_t end) {
    shadow_rows<PILEUS_WIDTH, true>(k, b, begin, end);
}
void march_kernel(const MarchParams& k, const MarchBuffers& b, std::uint32_t begin,
                  std::uint32_t end) {
    march_blocks<PILEUS_WIDTH, false, true>(k, b, begin, end);
}
void raymarch_kernel(const RaymarchParams& k, const RaymarchBuffers& b, std::uint32_t begin,
                     std::uint32_t end) {
    raymarch_detail_rows<PILEUS_WIDTH>(k, b, begin, end);
}

}  // namespace

extern const DetailKernels PILEUS_DETAIL(PILEUS_ISA);
const DetailKernels PILEUS_DETAIL(PILEUS_ISA) = {shadow_kernel, march_kernel, raymarch_kernel};

}  // namespace pileus
