// SPDX-License-Identifier: Apache-2.0
// Fuzz target: density grids without a head.
// in: type and byte order, three sides of 16 bits, then the file -> out: a lawful volume, or a
// line. docs/formats.md
#include "src/io/volumes/volume_file.h"
#include "tests/fuzz/target.h"

int fuzz::raw(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHead = 7;
    if (size < kHead) return 0;
    const auto type = pileus::RawType(data[0] % 3);
    std::array<int, 3> sides;
    for (std::size_t a = 0; a < 3; ++a) sides[a] = data[1 + 2 * a] | data[2 + 2 * a] << 8;
    pileus::Volume volume;
    const pileus::Status status =
        pileus::decode_raw_volume("v.raw", fuzz::text_of(data + kHead, size - kHead), type, sides,
                                  (data[0] & 128) != 0, volume);
    if (status)
        fuzz::check_volume(volume);
    else
        fuzz::check_fault(status, "v.raw:", true);
    return 0;
}
