// SPDX-License-Identifier: Apache-2.0
// From sums of photons to the radiance that each collector shows the observer.
// in: slots of integer sums, collectors, the camera -> out: colours, [channel][collector].
// docs/methods.md 3, each image frame, step 4; repairs 2 and 3.
#pragma once
#include "src/methods/collectors/prepare/prepared.h"
#include "src/photons/light_input.h"
#include "src/photons/scatter.h"

namespace pileus {

enum class Closure { kSh, kLobe, kCamera };

struct ReconstructInput : LightInput {
    Span<const Collector> collectors;
    Span<const float> shares;  ///< see Prepared; not read for one medium
    Closure closure = Closure::kSh;
    bool window = false;    ///< sinc window on the bands
    bool constant = false;  ///< add the lighting's constant source (billboards)
};

struct CollectorColours {
    Buffer<float> colour;  ///< [3 * (1 + batches)][collector]; radiance of an optically thick leaf
    std::uint64_t clamped_negative = 0;
};

namespace arrays {

/// So many numbers for each collector.
inline Array<float> collector_colours(std::uint64_t numbers, std::uint64_t collectors) {
    return {"collector colours", bytes_of(numbers, collectors), Stage::kReconstruct,
            Stage::kLayers};
}

}  // namespace arrays

/// Every colour is finite. With `constant` it is >= 0: negative ones are clamped and counted;
/// without, and in batches, whose spread is what matters, signs stay. kLimit: out of memory.
Status reconstruct(const ReconstructInput& in, CollectorColours& out);

/// Scattered light of collectors in all directions: set s holds bands*bands harmonics of what
/// leaves along a direction and, for each degree beyond them, what multiplies the Legendre
/// polynomial of its angle to the sunlight; to be multiplied by the set's colour. No constant part.
struct HarmonicSource {
    Buffer<float> values;  ///< [set][harmonic][collector]
    int numbers = 0, sets = 0;
    float colour[3][3] = {};  ///< [set][channel]
};

/// What `reconstruct` evaluates towards one camera, for all directions, from batch `batch` of the
/// slots, or from all: -1. Of `which` collectors alone, or of all where that is empty. Slots shot
/// under another sun are taken to be under this one beyond the bands. Closure kSh only. Nothing is
/// clamped. kLimit: out of memory.
Status reconstruct_harmonics(const ReconstructInput& in, int batch, Span<const std::uint32_t> which,
                             HarmonicSource& out);

}  // namespace pileus
