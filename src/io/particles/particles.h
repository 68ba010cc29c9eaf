// SPDX-License-Identifier: Apache-2.0
// Particles: places, radii, densities, colours, side by side in arrays.
// in: a source that nobody has checked -> out: this struct, every number finite and in range.
// docs/particles.md, "Data".
#pragma once
#include <cstdint>

#include "src/base/buffer.h"
#include "src/base/vectors.h"

namespace pileus {

/// Of a source without densities, colours or numbers those arrays are empty.
struct ParticleSet {
    std::uint64_t count = 0;
    Double3 origin{};          ///< what places are counted from, so that far ones keep their digits
    Buffer<float> position;    ///< [particle][axis], from the origin
    Buffer<float> radius;      ///< [particle]; > 0
    Buffer<float> density;     ///< [particle]; >= 0. Empty: 1
    Buffer<float> colour;      ///< [particle][channel]: albedo, 0 to 1. Empty: white
    Buffer<float> emission;    ///< [particle][channel]: factor on the medium's, >= 0. Empty: 1
    Buffer<float> velocity;    ///< [particle][axis], lengths per second. Empty: at rest
    Buffer<std::uint64_t> id;  ///< [particle]. Empty: told apart by their own numbers
    Double3 low{}, high{};     ///< corners of a box about all particles, their radii included

    float density_of(std::uint64_t i) const { return density.empty() ? 1.0f : density[i]; }
};

}  // namespace pileus
