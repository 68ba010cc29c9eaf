// SPDX-License-Identifier: Apache-2.0
// Upsampling, the air in front and 8-bit pixels, compiled once per instruction set, apart from
// isa.cpp so that both build at once. in: the kernel templates -> out: four exported functions,
// named after the set. docs/architecture.md, "Kernels: written once"; tools/check_objects proves
// that nothing leaks.
#include "kernels_cpu/core/profile.h"
#include "kernels_cpu/display/air_rows.h"
#include "kernels_cpu/display/finish_rows.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_UPSAMPLE(isa) PILEUS_JOIN(upsample_kernel_, isa)
#define PILEUS_PIXELS(isa) PILEUS_JOIN(pixel_kernel_, isa)
#define PILEUS_FINISH(isa) PILEUS_JOIN(finish_kernel_, isa)
#define PILEUS_AIR(isa) PILEUS_JOIN(air_kernel_, isa)

namespace pileus {
namespace {

#ifdef PILEUS_WITHOUT_UPSAMPLING
constexpr bool kUpsampling = false;
#else
constexpr bool kUpsampling = true;
#endif

}  // namespace

void PILEUS_UPSAMPLE(PILEUS_ISA)(const UpsampleParams&, const UpsampleBuffers&, std::uint32_t,
                                 std::uint32_t);
void PILEUS_UPSAMPLE(PILEUS_ISA)(const UpsampleParams& k, const UpsampleBuffers& b,
                                 std::uint32_t begin, std::uint32_t end) {
    if (kUpsampling) upsample_rows<PILEUS_WIDTH>(k, b, begin, end);
}

void PILEUS_PIXELS(PILEUS_ISA)(const PixelParams&, const PixelBuffers&, std::uint32_t,
                               std::uint32_t);
void PILEUS_PIXELS(PILEUS_ISA)(const PixelParams& k, const PixelBuffers& b, std::uint32_t begin,
                               std::uint32_t end) {
    pixel_rows<PILEUS_WIDTH>(k, b, begin, end);
}

void PILEUS_FINISH(PILEUS_ISA)(const FinishParams&, const FinishBuffers&, std::uint32_t,
                               std::uint32_t);
void PILEUS_FINISH(PILEUS_ISA)(const FinishParams& k, const FinishBuffers& b, std::uint32_t begin,
                               std::uint32_t end) {
    if (kUpsampling) finish_rows<PILEUS_WIDTH>(k, b, begin, end);
}

void PILEUS_AIR(PILEUS_ISA)(const AirRowsParams&, const AirRowsBuffers&, std::uint32_t,
                            std::uint32_t);
void PILEUS_AIR(PILEUS_ISA)(const AirRowsParams& k, const AirRowsBuffers& b, std::uint32_t begin,
                            std::uint32_t end) {
    if (kAtmosphere) air_rows(k, b, begin, end);
}

}  // namespace pileus
