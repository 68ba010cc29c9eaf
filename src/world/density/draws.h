// SPDX-License-Identifier: Apache-2.0
// Numbers drawn one after the other from a counter, and directions made of them.
// in: a seed, a stream -> out: the same numbers on every machine. src/base/random_streams.h
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "src/base/random_streams.h"

namespace pileus {

class Draws {
public:
    Draws(std::uint64_t seed, RandomStream stream) : key_(make_key(seed, stream, 0)) {}
    /// Uniform in [low, high).
    float between(float low, float high) {
        const std::uint32_t word = threefry<std::uint32_t>(key_.k0, key_.k1, count_++, 0).a;
        return low + (high - low) * uniform(word);
    }

private:
    Key key_;
    std::uint32_t count_ = 0;
};

struct Direction {
    float x, y, z;
};

/// Uniform over the part of the sphere above height `lowest`.
inline Direction draw_direction(Draws& draws, float lowest) {
    const float z = draws.between(lowest, 1.0f);
    const auto turn = sincos_turns(draws.between(0.0f, 1.0f));
    const float s = sqrt_(max_(1.0f - z * z, 0.0f));
    return {s * turn.cosine, s * turn.sine, z};
}

}  // namespace pileus
