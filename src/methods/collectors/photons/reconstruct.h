// SPDX-License-Identifier: Apache-2.0
// From sums of photons to the radiance that each collector shows the observer.
// in: slots of integer sums, collectors, the camera -> out: colours, [channel][collector].
// docs/methods.md 3, each image frame, step 4; repairs 2 and 3.
#pragma once
#include "src/photons/trace.h"
#include "src/methods/collectors/prepare/prepared.h"

namespace pileus {

enum class Closure { kSh, kLobe, kCamera };

struct ReconstructInput {
    const Medium* medium = nullptr;
    const Lighting* lighting = nullptr;
    const Photons* photons = nullptr;
    Span<const Collector> collectors;
    Span<const float> shares;  ///< see Prepared; not read for one medium
    CameraParams camera{};
    DepositPlan deposit;
    Closure closure = Closure::kSh;
    bool window = false;             ///< sinc window on the bands
    bool first_order_alone = false;  ///< only sunlight scattered once, where deposits keep it apart
    int batches = 0;        ///< also one RGB for each of so many groups of slots, for the error
    bool constant = false;  ///< add the lighting's constant source (billboards)
    int threads = 1;
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
/// Three channels of what the ground sends back.
inline Array<float> ground_light(std::uint64_t cells) {
    return {"ground map", bytes_of(3, cells), Stage::kBackground, Stage::kBackground};
}

}  // namespace arrays

/// Every colour is finite and >= 0; negative ones are clamped and counted (batches are not
/// clamped: their spread is what matters). kLimit: out of memory.
Status reconstruct(const ReconstructInput& in, CollectorColours& out);

/// Scattered light of every collector in all directions: set s holds bands*bands harmonics of what
/// leaves along a direction, to be multiplied by the set's colour. No constant part.
struct HarmonicSource {
    Buffer<float> values;  ///< [set][harmonic][collector]
    int bands = 0, sets = 0;
    float colour[3][3] = {};  ///< [set][channel]
};

/// Sets of a run whose sums have so many colour channels: one per light where light differs in
/// colour only, otherwise one per channel.
int harmonic_sets(int channels, const Lighting& lighting);

/// What `reconstruct` evaluates towards one camera, for all directions, from batch `batch` of the
/// slots, or from all: -1. Closure kSh only. Nothing is clamped. kLimit: out of memory.
Status reconstruct_harmonics(const ReconstructInput& in, int batch, HarmonicSource& out);

/// Radiance that the cells of the ground send back of the light scattered onto them (or kept from
/// them, then negative): [3][cells * cells]. `batch` 0: of all slots; 1 ... in.batches: of that
/// group of them alone. kLimit: out of memory.
Status reconstruct_ground(const ReconstructInput& in, const GroundMap& map, int batch,
                          Buffer<float>& radiance);

}  // namespace pileus
