// SPDX-License-Identifier: Apache-2.0
// Fuzz target: OpenEXR pictures through the library, behind our own checks.
// in: bytes as an .exr file -> out: a lawful picture of at most 4096 pixels, or one line.
// docs/formats.md
#include "src/io/image_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMostPixels = 4096;
    pileus::Image image;
    const pileus::Status status =
        pileus::decode_exr("p.exr", fuzz::text_of(data, size), image, kMostPixels);
    if (status)
        fuzz::check_picture(image, kMostPixels);
    else
        fuzz::check_fault(status, "p.exr", true);
    return 0;
}
