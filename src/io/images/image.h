// SPDX-License-Identifier: Apache-2.0
// A picture as planes of floats, and what writers need to know about it.
// in: composited layers -> out: one plane per channel, rows from the top.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "src/base/buffer.h"

namespace pileus {

struct Channel {
    std::string name;      ///< R G B A Z cloud.R ... error.R ...
    Buffer<float> pixels;  ///< width*height, rows from the top
};

/// What a picture is a part of, counted from its first pixel; width 0: the pixels themselves.
struct DisplayWindow {
    std::int64_t x = 0, y = 0, width = 0, height = 0;
};

struct Image {
    int width = 0, height = 0;
    DisplayWindow display;  ///< .exr files have it alone
    std::string foreign;    ///< of such a file: an attribute that gives its colours or its rows
                            ///< another meaning than ours, with what is allowed
    std::vector<Channel> channels;
    std::array<float, 16> world_to_camera{};  ///< row-major, OpenEXR's row-vector convention
    std::array<float, 16> world_to_ndc{};
    float screen_window_width = 1;  ///< of the picture, 1 in front of the camera
    /// R G B are linear light of a display, 0..1, not radiance: 8-bit files hold them as they are,
    /// without exposure and curve.
    bool display_colours = false;
    std::string scene_text;  ///< the scene's own text, stored in the file
    /// What else made the picture, name and text, stored as "pileus.NAME"; docs/formats.md.
    std::vector<std::pair<std::string, std::string>> origin;
    std::string pixel_hash;  ///< 16 hex digits

    const Channel* find(const char* name) const {
        for (const Channel& c : channels)
            if (c.name == name) return &c;
        return nullptr;
    }
};

}  // namespace pileus
