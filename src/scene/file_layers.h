// SPDX-License-Identifier: Apache-2.0
// Layers of files of pictures: a flight, which writes none, is compiled with a header in place of
// this. in: a scene's words -> out: what its pictures show besides. docs/formats.md, "Pictures out"
#pragma once

namespace pileus {

struct FileLayers {
    bool layer_error = false, layer_optical_depth = false, layer_transmittance = false;
    bool layer_light = false, layer_order = false;
    bool layer_reflectance = false, layer_shadow = false, layer_occlusion = false;
};

}  // namespace pileus
