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

}  // namespace pileus
