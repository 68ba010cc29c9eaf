// SPDX-License-Identifier: Apache-2.0
// Sunlight on nodes while the sun moves: each frame makes one slice of them anew.
// in: the suns of the last frames -> out: the slices to make, and for which sun.
// docs/realtime.md, "A sun that moves"
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "src/run/context.h"

namespace pileus {

using SunDirection = std::array<float, 3>;

/// The frame that light is made for.
struct SunTurn {
    int slices = 1;         ///< 1: all nodes anew for each sun
    std::int64_t turn = 0;  ///< number of the frame; each frame's is one more
    SunDirection sun{};
    std::function<SunDirection(std::int64_t)>
        sun_of{};  ///< of frames before the first that is made
};

/// The most that settings may ask for (light_refresh).
constexpr std::size_t kMaxSlices = 64;

/// Slice s is of the sun of the last frame whose number is s modulo the number of slices. So what
/// a frame has depends on the suns of that many frames alone, and a sun that stands is everywhere
/// after as many.
struct SunSlices {
    std::vector<SunDirection> suns;  ///< of the last frames, by number modulo slices
    std::vector<SunDirection> held;  ///< per slice, what its nodes were made for; empty: nothing
    std::int64_t last = 0;           ///< frame that `suns` ends with
    std::uint64_t made = 0;          ///< slices so far

    /// Room for as many slices as there may be.
    void reserve() {
        suns.reserve(kMaxSlices);
        held.reserve(kMaxSlices);
    }
};

/// Farthest that a slice's sun may be from the frame's, degrees; else all are of the frame's.
constexpr double kMaxSliceDeg = 1;

/// Takes up the frame's sun; the slices that are to be made for `SunSlices::held` now.
std::vector<int> follow_sun(const SunTurn& turn, SunSlices& slices);
/// All slices have been made for one sun.
void hold_sun(const SunDirection& sun, SunSlices& slices);

/// The optical depths of one slice of the nodes' rows, towards k.to_sun. Slices are of the host.
Status make_shadow_slice(const Context& context, const ShadowParams& k, const ShadowBuffers& b,
                         int slice, int slices);

}  // namespace pileus
