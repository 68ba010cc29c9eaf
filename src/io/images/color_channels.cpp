// SPDX-License-Identifier: Apache-2.0
// See image_file.h: the colours among the channels of a picture.
#include "src/io/images/image_file.h"

namespace pileus {

Status color_channels(const Image& image, const Channel* (&rgb)[3]) {
    const Channel* grey = image.find("Y");
    const char* const names[3] = {"R", "G", "B"};
    for (int i = 0; i < 3; ++i) {
        rgb[i] = image.find(names[i]);
        if (rgb[i] == nullptr) rgb[i] = grey;
        if (rgb[i] == nullptr)
            return Status::bad_input(std::string("image: channel ") + names[i] +
                                     ": missing, allowed: R G B, or Y");
    }
    return Status::ok();
}

}  // namespace pileus
