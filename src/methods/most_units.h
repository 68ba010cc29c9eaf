// SPDX-License-Identifier: Apache-2.0
// The most that pictures take, in units that depend on settings and sizes alone, not on the view.
// in: the work of a frame, sizes, media, lights -> out: FrameUnits.
// docs/realtime.md, "Maximum cost of a frame"
#pragma once
#include "src/methods/scenery.h"
#include "src/picture/upsample.h"

namespace pileus {

/// Pixels of a picture, and those that are marched where the frame before left `memory`; `opaque`:
/// something solid may be in it.
void most_pixels(const FrameWork& work, const std::array<int, 2>& size, bool opaque,
                 const UpsampleMemory& memory, FrameUnits& out);

/// Places at which a march in steps of the grid looks up the medium along one ray. kBadInput: a
/// periodic medium, where a level ray has no end.
Status most_grid_samples(const Medium& medium, std::uint64_t& samples);

/// Adds the march through the light of lamps and of the media, where there is such light. Errors:
/// as above.
Status add_lamp_samples(const Medium& medium, const Lighting& lighting, FrameUnits& out);

}  // namespace pileus
