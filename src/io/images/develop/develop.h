// SPDX-License-Identifier: Apache-2.0
// A picture of radiance as a display shows it: white balance, glare, exposure, tone curve, codes.
// in: channels R G B, or Y -> out: 8 bits each.
// docs/exposure.md
#pragma once
#include <cstdint>

#include "src/base/buffer.h"
#include "src/io/images/develop/tone_settings.h"
#include "src/io/images/image.h"

namespace pileus {

/// sRGB, 3 bytes a pixel, rows from the top. A single channel Y counts as grey. Colours of a
/// display stay as they are. No channels: kBadInput; memory: kLimit.
Status tone_map_8bit(const Image& image, const ToneSettings& tone, Buffer<std::uint8_t>& rgb);

/// Stops over the daylight exposure that tone_map_8bit takes for this picture.
Status measured_stops(const Image& image, const ToneSettings& tone, double& stops);

}  // namespace pileus
