// SPDX-License-Identifier: Apache-2.0
// Fuzz target: density grids in pbrt's text form.
// in: bytes as a .pbrt file -> out: a lawful volume, or one line with its place.
// docs/formats.md
#include "src/io/volumes/volume_file.h"
#include "tests/fuzz/target.h"

int fuzz::pbrt(const std::uint8_t* data, std::size_t size) {
    pileus::Volume volume;
    const pileus::Status status =
        pileus::decode_pbrt_volume("v.pbrt", fuzz::text_of(data, size), volume);
    if (status)
        fuzz::check_volume(volume);
    else
        fuzz::check_fault(status, "v.pbrt:", true);
    return 0;
}
