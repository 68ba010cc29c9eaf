// SPDX-License-Identifier: Apache-2.0
// Fuzz target: NanoVDB grids.
// in: bytes as an .nvdb file -> out: a lawful volume and an equal head, or one line with its place.
// docs/formats.md
#include "src/io/nvdb_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    pileus::VdbLimits limits;
    limits.max_cells = limits.free_cells = std::uint64_t{1} << 16;
    pileus::Volume volume;
    pileus::VolumeHead head;
    const pileus::Span<const char> bytes = fuzz::text_of(data, size);
    const pileus::Status status = pileus::decode_nvdb("v.nvdb", bytes, "", limits, volume);
    const pileus::Status seen = pileus::decode_nvdb_head("v.nvdb", bytes, "", limits, head);
    if (!status) {
        fuzz::check_fault(status, "v.nvdb:", true);
        return 0;
    }
    fuzz::check_volume(volume);
    fuzz::require(bool(seen) && head.size == volume.size, "a head tells the size of the whole");
    return 0;
}
