// SPDX-License-Identifier: Apache-2.0
// Procedural skies, compiled once per instruction set, apart from isa.cpp so that both build at
// once. in: the kernel templates -> out: a table of functions, named after the instruction set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/procedural/cumulus.h"
#include "kernels_cpu/procedural/sky_bake.h"
#include "kernels_cpu/procedural/sky_noise.h"
#include "kernels_cpu/raymarch/raymarch_sky.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_SKY(isa) PILEUS_JOIN(sky_kernel_, isa)

namespace pileus {
namespace {

void noise_kernel(const NoiseParams& k, float* values, std::uint32_t begin, std::uint32_t end) {
    noise_rows<PILEUS_WIDTH>(k, values, begin, end);
}
void bake_kernel(const BakeParams& k, float* density, std::uint32_t begin, std::uint32_t end) {
    bake_sky_rows<PILEUS_WIDTH>(k, density, begin, end);
}
void columns_kernel(const ColumnParams& k, float* most, std::uint32_t begin, std::uint32_t end) {
    sky_columns<PILEUS_WIDTH>(k, most, begin, end);
}
void raymarch_kernel(const RaymarchParams& k, const SkyParams& sky, const RaymarchBuffers& b,
                     std::uint32_t begin, std::uint32_t end) {
    raymarch_sky_rows<PILEUS_WIDTH>(k, sky, b, begin, end);
}
std::int64_t light_kernel(const RaymarchParams& k, const SkyParams& sky, const SkyLightView& view,
                          const SkyLightRow* rows, std::int32_t* words, std::uint32_t begin,
                          std::uint32_t end) {
    return sky_light_rows<PILEUS_WIDTH>(k, sky, view, rows, words, begin, end);
}

void cumulus_kernel(const CumulusParams& k, float* density, std::int32_t* scratch,
                    std::uint32_t begin, std::uint32_t end) {
    fill_cumulus<PILEUS_WIDTH>(k, density, scratch, begin, end);
}

}  // namespace

extern const SkyKernels PILEUS_SKY(PILEUS_ISA);
const SkyKernels PILEUS_SKY(PILEUS_ISA) = {PILEUS_WIDTH,   noise_kernel,    bake_kernel,
                                           columns_kernel, raymarch_kernel, light_kernel,
                                           cumulus_kernel};

}  // namespace pileus
