// SPDX-License-Identifier: Apache-2.0
// Fuzz target: portable float maps.
// in: bytes as a .pfm file -> out: a lawful picture that survives a round trip, or one line.
// docs/formats.md
#include <cstring>

#include "src/io/images/image_file.h"
#include "tests/fuzz/target.h"

int fuzz::pfm(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMaxPixels = 4096;
    pileus::Image image, again;
    const pileus::Status status =
        pileus::decode_pfm("p.pfm", fuzz::text_of(data, size), image, kMaxPixels);
    if (!status) {
        fuzz::check_fault(status, "p.pfm:", true);
        return 0;
    }
    fuzz::check_picture(image, kMaxPixels);

    // Written and read again, every float must come back with all its bits.
    pileus::Buffer<char> bytes;
    fuzz::require(bool(pileus::encode_pfm(image, bytes)), "what was read can be written");
    fuzz::require(bool(pileus::decode_pfm("q.pfm", bytes.span(), again, kMaxPixels)),
                  "what was written can be read");
    for (std::size_t c = 0; c < 3; ++c) {
        const auto &a = image.channels[c].pixels, &b = again.channels[c].pixels;
        fuzz::require(a.size() == b.size() && std::memcmp(a.data(), b.data(), a.bytes()) == 0,
                      "a round trip keeps every bit");
    }
    return 0;
}
