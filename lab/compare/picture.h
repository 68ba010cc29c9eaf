// SPDX-License-Identifier: Apache-2.0
// Pictures of any renderer as R G B A of their display window, under names of ours.
// in: .exr .pfm .png with channels of any name -> out: an Image that can be compared.
// docs/compare.md, "Foreign files"
#pragma once
#include <cstdint>
#include <string>

#include "src/base/status.h"
#include "src/io/images/image.h"
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

/// Crops or pads all channels with zeros to the display window. Faults: those of check_image_size,
/// memory.
Status fit_display_window(const std::string& name, Image& image,
                          std::uint64_t most_pixels = kMaxImagePixels);

/// Reads a file and does both. `said` says in a few words what was done to it, empty for a picture
/// of our own. Errors: those of read_image, and the above.
Status read_picture(const std::string& path, const std::string& layer, Image& image,
                    std::string& said);

/// Makes of a picture of radiance what its .png would be read as: R G B are the light of a display,
/// `display_colours` is set, A stays, all other channels go. A picture of display colours stays as
/// it is. kBadInput: no colours; kLimit: memory.
Status develop_image(const ToneSettings& tone, Image& image);

}  // namespace pileus
