// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: the ground of a flight is grey land.
// in: nothing -> out: nothing. docs/flight.md, "Build"
#pragma once
#include "src/methods/march/march_state.h"

namespace pileus {

inline Status mirror_sky(const Context&, const FrameView&, const RaymarchInput&, const Lighting&,
                         MarchState&) {
    return Status::ok();
}

}  // namespace pileus
