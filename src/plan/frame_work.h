// SPDX-License-Identifier: Apache-2.0
// What one frame of a session may cost, in units that no clock decides.
// in: a host, or the governor -> out: settings of the method that a frame may have of its own.
// docs/realtime.md, "Work and the governor"
#pragma once
#include <cstdint>

namespace pileus {

/// 0 in a member: as the scene has it. Members that the method does not have stay 0.
struct FrameWork {
    int scale = 0;             ///< one pixel of so many along x and y is marched: 1, 2, 4
    int temporal = 0;          ///< the same with the rest from the frame before: 2, 4
    int steps = 0;             ///< most of a ray; of method particles its bins
    int light_refresh = 0;     ///< frames in which sunlight on nodes follows the sun
    std::int64_t photons = 0;  ///< of one generation, at most the scene's

    bool operator==(const FrameWork& o) const {
        return scale == o.scale && temporal == o.temporal && steps == o.steps &&
               light_refresh == o.light_refresh && photons == o.photons;
    }
};

/// What one frame takes at the most: one unit of light and one picture.
struct FrameUnits {
    std::uint64_t pixels = 0;   ///< of the picture
    std::uint64_t rays = 0;     ///< pixels that are marched; of method path samples of pixels
    std::uint64_t samples = 0;  ///< places at which these rays look up the medium
    std::uint64_t photons = 0;
};

/// Of one unit each, and of what a frame takes whatever its work is: seconds, instructions, or
/// what else adds up.
struct UnitCosts {
    double fixed = 0, pixel = 0, ray = 0, sample = 0, photon = 0;
};

inline double cost_of(const FrameUnits& units, const UnitCosts& costs) {
    return costs.fixed + double(units.pixels) * costs.pixel + double(units.rays) * costs.ray +
           double(units.samples) * costs.sample + double(units.photons) * costs.photon;
}

}  // namespace pileus
