// SPDX-License-Identifier: Apache-2.0
// A picture of lit particles, tile by tile: each tile takes those that its rays may meet, the
// nearest first, so that what lies behind an opaque front is not looked at. in: balls, a camera,
// light -> out: planes of pixels. docs/particles.md, "Display".
#pragma once
#include "kernels_cpu/particles/particle_board_params.h"
#include "src/methods/particles/particles_state.h"

namespace pileus {

namespace arrays {

/// At most; larger tiles name fewer balls twice.
inline Array<std::uint32_t> view_balls(std::uint64_t particles) {
    return {"particles by tiles of the picture", bytes_of(4, particles), Stage::kDisplay,
            Stage::kDisplay};
}

}  // namespace arrays

/// What one thread works in, bytes.
std::uint64_t view_tile_scratch_bytes();

/// Marches all pixels. Neither threads nor the width of kernels change a bit. kLimit: out of
/// memory.
Status march_particles(const Context& context, const ParticleTree& tree,
                       const ParticleMarchParams& k, const ParticleMarchBuffers& buffers);

/// The same with boards, one for each ball of the tree, whose pixels are found here; planes go on
/// from what they hold.
Status blend_particles(const Context& context, const ParticleTree& tree,
                       const ParticleBoardParams& k, Span<ParticleBoard> boards,
                       const ParticleBoardBuffers& buffers);

}  // namespace pileus
