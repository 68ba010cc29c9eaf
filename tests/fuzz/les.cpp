// SPDX-License-Identifier: Apache-2.0
// Fuzz target: clouds that large-eddy simulations leave as text.
// in: bytes as a .txt file -> out: a lawful volume, or one line with its place.
// docs/formats.md
#include "src/io/volumes/volume_file.h"
#include "tests/fuzz/target.h"

int fuzz::les(const std::uint8_t* data, std::size_t size) {
    pileus::Volume volume;
    const pileus::Status status =
        pileus::decode_les_volume("v.txt", fuzz::text_of(data, size), volume);
    if (status)
        fuzz::check_volume(volume);
    else
        fuzz::check_fault(status, "v.txt:", true);
    return 0;
}
