// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: a flight writes no files, so compilers drop what is for
// layers alone. in: nothing -> out: nothing. docs/flight.md, "Build"
#pragma once

namespace pileus {

/// False, whatever it is told.
struct NoLayer {
    constexpr NoLayer() = default;
    constexpr NoLayer(bool) {}
    constexpr operator bool() const { return false; }
};

struct FileLayers {
    NoLayer layer_error, layer_optical_depth, layer_transmittance, layer_light, layer_order;
    NoLayer layer_reflectance, layer_shadow, layer_occlusion;
};

}  // namespace pileus
