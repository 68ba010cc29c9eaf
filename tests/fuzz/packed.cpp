// SPDX-License-Identifier: Apache-2.0
// Fuzz target: packed scenes behind a head with the right length and digest.
// in: arbitrary bytes -> out: a world whose arrays are as long as it says, or one line.
// docs/flight.md, "Packed scenes".
#include <cstring>

#include "src/flight/pack.h"
#include "tests/fuzz/target.h"

int fuzz::packed(const std::uint8_t* data, std::size_t size) {
    using namespace pileus;
    PackedHead head;
    head.method = "raymarch";
    const std::string bytes =
        packed_bytes(head, std::string(reinterpret_cast<const char*>(data), size));
    Packed out;
    const Status status = unpack_scene(bytes.data(), bytes.size(), false, out);
    if (!status) {
        fuzz::require(status.message.rfind("packed scene: ", 0) == 0,
                      "faults name what they are of");
        return 0;
    }
    Buffer<char> still;
    fuzz::require(bool(still.resize(bytes.size(), "packed scene")), "memory for its bytes");
    std::memcpy(still.data(), bytes.data(), bytes.size());
    Packed in_place;
    fuzz::require(bool(unpack_scene(still.data(), still.size(), true, in_place)), "in place, too");
    const auto same = [](const Buffer<float>& a, const Buffer<float>& b) {
        return a.size() == b.size() &&
               (a.empty() || std::memcmp(a.data(), b.data(), a.bytes()) == 0);
    };
    fuzz::require(same(in_place.world->medium.volume.density, out.world->medium.volume.density) &&
                      same(in_place.world->medium.parts, out.world->medium.parts),
                  "the same numbers in place");
    const Medium& medium = out.world->medium;
    const std::uint64_t cells = voxel_count(medium.grid);
    fuzz::require(out.world->direct_sky || medium.volume.density.size() == cells,
                  "a density for each cell");
    fuzz::require(medium.parts.size() == cells * std::uint64_t(medium.count - 1), "parts, too");
    for (const Optics& optics : medium.optics)
        if (optics.phase.table != nullptr)
            fuzz::require(optics.phase.table->turn != nullptr, "tables point at their arrays");
    return 0;
}
