// SPDX-License-Identifier: Apache-2.0
// See flight.h.
#include "src/flight/flight.h"

namespace pileus {

Status begin_flight(const void* scene, std::size_t bytes, std::uint64_t room,
                    const RenderOptions& options, bool in_place, bool depth, Packed& packed,
                    Session& session) {
    PILEUS_TRY(unpack_scene(scene, bytes, in_place, packed));
    const PackedHead& head = packed.head;
    if (room < (packed.in_place ? head.in_place_bytes : head.block_bytes))
        return Status::limit(
            "flight.block: too few bytes, allowed: those that pileus_packed_read tells");
    // The digest keeps accidents out; this, a head from elsewhere: it tells how large pictures are.
    const auto& size = packed.scene.camera.resolution;
    if (head.width != std::uint64_t(size[0]) || head.height != std::uint64_t(size[1]) ||
        head.method != packed.scene.method)
        return Status::bad_input(
            "packed scene: its head is of another one, allowed: what `pileus pack` of this version "
            "wrote");
    RenderOptions own = options;
    if (packed.scene.sky.mapped) own.sky = &packed.sky;
    PILEUS_TRY(session.open(packed.scene, own, true, packed.world));
    if (depth) PILEUS_TRY(session.reserve_depth());
    PILEUS_TRY(session.reserve());
    const LightUnits light = session.light();
    std::uint64_t done = 0;
    return light.whole > 0 ? session.step(light.whole, done) : Status::ok();
}

}  // namespace pileus
