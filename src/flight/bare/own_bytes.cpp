// SPDX-License-Identifier: Apache-2.0
// What a flight takes, by its block: it has no plan.
// in: a block -> out: bytes beside its world. docs/flight.md, "Memory"
#include "src/flight/block.h"
#include "src/flight/flight.h"

namespace pileus {

std::uint64_t own_bytes(const Session&, const Block* block, const Packed* packed,
                        std::uint64_t world_bytes) {
    const std::uint64_t kept = block->use().kept_bytes;
    // A block does not keep a world that is read in place.
    const std::uint64_t world = packed->in_place ? 0 : world_bytes;
    return kept > world ? kept - world : 0;
}

}  // namespace pileus
