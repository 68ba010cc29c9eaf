// SPDX-License-Identifier: Apache-2.0
// Particles, compiled once per instruction set, apart from isa.cpp so that both build at once.
// in: the kernel templates -> out: a table of functions, named after the instruction set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/particles/particle_board.h"
#include "kernels_cpu/particles/particle_lamps.h"
#include "kernels_cpu/particles/particle_light.h"
#include "kernels_cpu/particles/particle_march.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_PARTICLES(isa) PILEUS_JOIN(particle_kernel_, isa)

namespace pileus {
namespace {

void depths_kernel(const ParticleDepthParams& k, const ParticleDepthBuffers& b, std::uint32_t begin,
                   std::uint32_t end) {
    particle_depths<PILEUS_WIDTH>(k, b, begin, end);
}
void march_kernel(const ParticleMarchParams& k, const ParticleMarchBuffers& b,
                  const ParticleTile& tile) {
    particle_tile<PILEUS_WIDTH>(k, b, tile);
}
void boards_kernel(const ParticleBoardParams& k, const ParticleBoardBuffers& b,
                   const ParticleTile& tile) {
    board_tile<PILEUS_WIDTH>(k, b, tile);
}
void colours_kernel(const ParticleMarchParams& k, const ParticleColourBuffers& b,
                    std::uint32_t begin, std::uint32_t end) {
    board_colours<PILEUS_WIDTH>(k, b, begin, end);
}
void lamp_depths_kernel(const ParticleLampDepths& k, std::uint32_t begin, std::uint32_t end) {
    particle_lamp_depths<PILEUS_WIDTH>(k, begin, end);
}
void lamp_light_kernel(const ParticleMarchParams& k, const ParticleLampLight& b,
                       std::uint32_t begin, std::uint32_t end) {
    particle_lamp_light<PILEUS_WIDTH>(k, b, begin, end);
}

}  // namespace

extern const ParticleKernels PILEUS_PARTICLES(PILEUS_ISA);
const ParticleKernels PILEUS_PARTICLES(PILEUS_ISA) = {
    PILEUS_WIDTH,   depths_kernel,      march_kernel,     boards_kernel,
    colours_kernel, lamp_depths_kernel, lamp_light_kernel};

}  // namespace pileus
