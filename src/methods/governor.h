// SPDX-License-Identifier: Apache-2.0
// Chooses the work of a session's next frame from how long frames took. It looks at no clock.
// in: seconds of each frame, as the host measured them -> out: a FrameWork, the same for the same
// seconds. docs/realtime.md, "Work and the governor"
#pragma once
#include <vector>

#include "src/plan/frame_work.h"

namespace pileus {

constexpr std::size_t kMaxWorkLevels = 12;

/// What it remembers; cleared before the first frame.
struct Governor {
    double target_s = 0;                 ///< wall time that a frame may take; > 0
    std::uint32_t level = 0;             ///< of the ladder; 0: everything
    std::uint32_t frames = 0;            ///< at this level
    std::uint32_t spare = 0;             ///< of these, in a row, with time to spare
    double recent_s[2] = {};             ///< the last two frames
    double cost_s[kMaxWorkLevels] = {};  ///< of each level; 0: never seen
};

/// From all of `whole`, the scene's work, to less and less: fewer marched pixels first, then half,
/// a quarter, ... of the photons, or fewer steps. At most kMaxWorkLevels.
std::vector<FrameWork> work_ladder(const FrameWork& whole);

/// The work of the next frame, after one that took `frame_s`; 0: no frame yet. The median of three
/// frames counts, so that one that was held up changes nothing; the first frame of a level, which
/// makes what the level needs, does not count. A level above is tried again after a while in which
/// a fifth of the time was spare, unless it is known to be too slow, which is forgotten by and by.
FrameWork govern(const std::vector<FrameWork>& ladder, double frame_s, Governor& governor);

}  // namespace pileus
