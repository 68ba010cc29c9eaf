// SPDX-License-Identifier: Apache-2.0
// Fuzz target: OpenEXR pictures through the library, behind our own checks.
// in: bytes as an .exr file -> out: a lawful picture of at most 4096 pixels, or one line; the same
// of the layer and the display window that a comparison would take. docs/formats.md,
// docs/compare.md
#include "lab/compare/picture.h"
#include "tests/fuzz/target.h"

int fuzz::exr(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMaxPixels = 4096;
    pileus::Image image;
    const pileus::Status status =
        pileus::decode_exr("p.exr", fuzz::text_of(data, size), image, kMaxPixels);
    if (!status) {
        fuzz::check_fault(status, "p.exr", true);
        return 0;
    }
    fuzz::check_picture(image, kMaxPixels);
    std::string chosen;
    pileus::Status taken = pileus::choose_layer("p.exr", "", image, chosen);
    if (taken) taken = pileus::fit_display_window("p.exr", image, kMaxPixels);
    if (taken)
        fuzz::check_picture(image, kMaxPixels);
    else
        fuzz::check_fault(taken, "p.exr", true);
    return 0;
}
