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
#include "src/io/images/picture_layers.h"

namespace pileus {

/// Reads a file and does both. `said` says in a few words what was done to it, empty for a picture
/// of our own. Errors: those of read_image, and the above.
Status read_picture(const std::string& path, const std::string& layer, Image& image,
                    std::string& said);

/// Makes of a picture of radiance what its .png would be read as: R G B are the light of a display,
/// `display_colours` is set, A stays, all other channels go. A picture of display colours stays as
/// it is. kBadInput: no colours; kLimit: memory.
Status develop_image(const ToneSettings& tone, Image& image);

}  // namespace pileus
