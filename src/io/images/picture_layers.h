// SPDX-License-Identifier: Apache-2.0
// The picture, or the depth, among the layers of a foreign file, and its place on the display.
// in: channels of any name and a window -> out: R G B A and error.R/G/B; a plane of distances.
// docs/compare.md, "Foreign files"; docs/solids.md, "A depth image"
#pragma once
#include <string>

#include "src/base/status.h"
#include "src/io/images/image_file.h"

namespace pileus {

/// Keeps R G B (or Y), A and error.R/G/B of one layer, under these names. `layer` is the text
/// before
/// ".R"; empty: channels without a layer, else the only layer with colours, else one that is called
/// as a renderer calls its picture (Combined, beauty, ...). A single channel, or a layer that has
/// only R, V, L or Y, is Y. `chosen` names the layer taken. None or several: kBadInput with the
/// names to choose from.
Status choose_layer(const std::string& name, const std::string& layer, Image& image,
                    std::string& chosen);

/// Crops or pads all channels to the display window; what it has beyond the pixels becomes
/// `outside`. Faults: those of check_image_size, memory.
Status fit_display_window(const std::string& name, Image& image,
                          std::uint64_t most_pixels = kMaxImagePixels, float outside = 0);

/// Keeps columns x0 to x1 - 1 and rows y0 to y1 - 1, which lie in the image. kLimit: no memory.
Status cut_pixels(int x0, int y0, int x1, int y1, Image& image);

/// Where one of two pictures is a part of a picture of the other's size, that part of the other.
/// `cut`: which one was, null: none.
Status cut_to_part(Image& a, Image& b, const Image*& cut);

}  // namespace pileus
