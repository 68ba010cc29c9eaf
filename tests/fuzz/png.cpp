// SPDX-License-Identifier: Apache-2.0
// Fuzz target: PNG pictures through libpng, behind our own checks.
// in: bytes as a .png file -> out: a lawful picture of at most 4096 pixels, or one line.
// docs/formats.md
#include "src/io/images/image_file.h"
#include "tests/fuzz/target.h"

int fuzz::png(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMaxPixels = 4096;
    pileus::Image image;
    const pileus::Status status =
        pileus::decode_png("p.png", fuzz::text_of(data, size), image, kMaxPixels);
    if (!status) {
        fuzz::check_fault(status, "p.png", true);
        return 0;
    }
    fuzz::check_picture(image, kMaxPixels);
    for (const pileus::Channel& channel : image.channels)
        for (const float v : channel.pixels.span())
            fuzz::require(v >= 0.0f && v <= 1.0f, "light of a display is in [0, 1]");
    return 0;
}
