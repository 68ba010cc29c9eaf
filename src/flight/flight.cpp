// SPDX-License-Identifier: Apache-2.0
// See flight.h.
#include "src/flight/flight.h"

namespace pileus {

Status begin_flight(const void* scene, std::size_t bytes, const RenderOptions& options,
                    bool in_place, bool depth, Packed& packed, Session& session) {
    PILEUS_TRY(unpack_scene(scene, bytes, in_place, packed));
    PILEUS_TRY(session.open(packed.scene, options, SessionKind::kLive, true, packed.world));
    const LightUnits light = session.light();
    std::uint64_t done = 0;
    if (light.whole > 0) PILEUS_TRY(session.step(light.whole, done));
    return depth ? session.reserve_depth() : Status::ok();
}

}  // namespace pileus
