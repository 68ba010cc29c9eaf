// SPDX-License-Identifier: Apache-2.0
// The sweep of optical depth and the turning of skylight, compiled once per instruction set, apart
// from isa.cpp so that both build at once. in: the kernel templates -> out: three exported
// functions, named after the set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/light/sweep_layer.h"
#include "kernels_cpu/light/sweep_turned.h"
#include "kernels_cpu/raymarch/sky_turn.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_SWEEP(isa) PILEUS_JOIN(sweep_kernel_, isa)
#define PILEUS_SWEEP_LAYER(isa) PILEUS_JOIN(sweep_layer_kernel_, isa)
#define PILEUS_TURN_SKY(isa) PILEUS_JOIN(turn_sky_kernel_, isa)

namespace pileus {

void PILEUS_SWEEP(PILEUS_ISA)(const SweepParams&, const SweepBuffers&, std::uint32_t);
void PILEUS_SWEEP(PILEUS_ISA)(const SweepParams& k, const SweepBuffers& b, std::uint32_t block) {
    if (k.axis == 0)
        sweep_block_of_columns<PILEUS_WIDTH>(k, b, sweep_block_at(k, block));
    else
        sweep_block_of_rows<PILEUS_WIDTH>(k, b, sweep_block_at(k, block));
}

void PILEUS_SWEEP_LAYER(PILEUS_ISA)(const SweepLayerParams&, const SweepBuffers&, std::uint32_t,
                                    std::uint32_t);
void PILEUS_SWEEP_LAYER(PILEUS_ISA)(const SweepLayerParams& k, const SweepBuffers& b,
                                    std::uint32_t begin, std::uint32_t end) {
    sweep_layer_rows<PILEUS_WIDTH>(k, b, begin, end);
}

void PILEUS_TURN_SKY(PILEUS_ISA)(const SkyTurnParams&, const SkyTurnBuffers&, std::uint32_t,
                                 std::uint32_t);
void PILEUS_TURN_SKY(PILEUS_ISA)(const SkyTurnParams& k, const SkyTurnBuffers& b,
                                 std::uint32_t begin, std::uint32_t end) {
    turn_sky<PILEUS_WIDTH>(k, b, begin, end);
}

}  // namespace pileus
