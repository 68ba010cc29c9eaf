// SPDX-License-Identifier: Apache-2.0
// Fuzz target: OpenVDB fog volumes.
// in: bytes as a .vdb file -> out: a lawful volume and an equal head, or one line with its place.
// docs/formats.md
#include "src/io/vdb_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    pileus::VdbLimits limits;
    limits.max_cells = limits.free_cells = std::uint64_t{1} << 16;
    pileus::Volume volume;
    pileus::VolumeHead head;
    const pileus::Span<const char> bytes = fuzz::text_of(data, size);
    const pileus::Status status = pileus::decode_vdb("v.vdb", bytes, "", limits, volume);
    const pileus::Status seen = pileus::decode_vdb_head("v.vdb", bytes, "", limits, head);
    if (!status) {
        fuzz::check_fault(status, "v.vdb:", true);
        return 0;
    }
    fuzz::check_volume(volume);
    fuzz::require(bool(seen) && head.size == volume.size, "a head tells the size of the whole");
    return 0;
}
