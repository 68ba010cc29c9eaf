// SPDX-License-Identifier: Apache-2.0
// Fuzz target: binary density grids.
// in: bytes as a .vol file -> out: a lawful volume, or one line with its place.
// docs/formats.md
#include "src/io/volumes/volume_file.h"
#include "tests/fuzz/target.h"

int fuzz::vol(const std::uint8_t* data, std::size_t size) {
    pileus::Volume volume;
    const pileus::Status status =
        pileus::decode_vol_volume("v.vol", fuzz::text_of(data, size), volume);
    if (status)
        fuzz::check_volume(volume);
    else
        fuzz::check_fault(status, "v.vol:", true);
    return 0;
}
