// SPDX-License-Identifier: Apache-2.0
// What a session takes, by its plan; src/flight/bare has the one of flights.
// in: a session -> out: bytes beside its world. docs/embedding.md
#include "src/flight/flight.h"

namespace pileus {

std::uint64_t own_bytes(const Session& session, const Block*, const Packed*,
                        std::uint64_t world_bytes) {
    const std::uint64_t peak = session.plan().memory.peak();
    return peak > world_bytes ? peak - world_bytes : 0;
}

}  // namespace pileus
