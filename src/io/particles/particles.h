// SPDX-License-Identifier: Apache-2.0
// Particles as a file or a recipe says them: arrays side by side, and nothing of the scene.
// in: files that nobody has checked -> out: this struct, every number finite.
// docs/particles.md, "Data".
#pragma once
#include <cstdint>

#include "src/base/buffer.h"
#include "src/base/vectors.h"

namespace pileus {

/// Arrays that a source has nothing of are empty. Lengths in the source's own unit.
struct ParticleSet {
    std::uint64_t count = 0;
    Double3 origin{};  ///< what positions are counted from, so that far ones keep their digits
    Buffer<float> position;  ///< [particle][axis], from the origin
    Buffer<float> radius;    ///< [particle]; > 0. Empty: the scene says one for all
    Buffer<float> density;   ///< [particle]; >= 0. Empty: 1
    Buffer<float> colour;    ///< [particle][channel]: albedo in [0, 1]. Empty: white
    Buffer<float>
        emission;  ///< [particle][channel]: radiance per metre at its centre, >= 0. Empty: none
    Buffer<float> velocity;    ///< [particle][axis], units per second. Empty: at rest
    Buffer<std::uint64_t> id;  ///< [particle]. Empty: particles are told apart by their own bits
};

}  // namespace pileus
