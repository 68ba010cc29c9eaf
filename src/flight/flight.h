// SPDX-License-Identifier: Apache-2.0
// Sessions over packed scenes, up to the first picture; and what such a session needs.
// in: a packed scene -> out: a lit session; bytes of a block.
// docs/flight.md
#pragma once
#include "src/flight/pack.h"
#include "src/session/session.h"

namespace pileus {

class Block;

/// Unpacks the scene, prepares its method, takes what memory any work and any kind of picture may
/// need, and traces light for a first picture. The session points into `packed`. `in_place`: arrays
/// stay where they lie in `scene`. `depth`: leaves room for depth images. Errors: those of
/// unpack_scene and of sessions; kBadInput: a head that is not the scene's; kLimit: `room` is below
/// what the head asks for.
Status begin_flight(const void* scene, std::size_t bytes, std::uint64_t room,
                    const RenderOptions& options, bool in_place, bool depth, Packed& packed,
                    Session& session);

/// Bytes of a block for a packed scene, as docs/flight.md, "Memory", works them out.
struct FlightNeed {
    std::uint64_t kept = 0;      ///< of what lives as long as the session
    std::uint64_t open = 0;      ///< most while it is made
    std::uint64_t frame = 0;     ///< most that a call took, over frames near and far
    std::uint64_t small = 0;     ///< for what an ordinary library keeps elsewhere, by measurement
    std::uint64_t block = 0;     ///< what to give
    std::uint64_t in_place = 0;  ///< what to give where arrays are read in place
    FrameUnits most;             ///< that a frame takes; all 0: the view decides
};

/// Opens the scene in a block of its own and draws some frames. Errors: those of sessions.
Status measure_flight(const std::string& packed, const RenderOptions& options, FlightNeed& need);

/// Bytes beside a world of so many: by the plan, or in a flight library, which has none, by the
/// block. `block`, `packed`: null where there is no flight.
std::uint64_t own_bytes(const Session& session, const Block* block, const Packed* packed,
                        std::uint64_t world_bytes);

}  // namespace pileus
