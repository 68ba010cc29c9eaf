// SPDX-License-Identifier: Apache-2.0
// Keys of method `optical-depth`.
// in: checked values <-> out: fields of OpticalDepthSettings.
// docs/scene.md; docs/optical-depth.md says what each does.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField simple = field<&Scene::optical_depth, Members...>;
using Settings = OpticalDepthSettings;

constexpr KeyRow kRows[] = {
    {"optical_depth.intensity", simple<&Settings::intensity>, from_to(0, 1e6), "",
     "factor on the sun's light"},
    {"optical_depth.ambient", simple<&Settings::ambient>, from_to(0, 1e12), "",
     "radiance that an opaque medium shows without the sun's light"},
    {"optical_depth.powder_strength", simple<&Settings::powder_strength>, from_to(0, 1e6), "",
     "how much light the powder effect takes where little medium lies before the sun; 0: none"},
    {"optical_depth.powder_depth", simple<&Settings::powder_depth>, from_to(0, 1e9), "",
     "how soon the powder effect fades: factor on the optical depth, or metres on the extinction"},
    {"optical_depth.powder_by", simple<&Settings::powder_by_extinction>,
     one_of("optical-depth|extinction"), "",
     "what the powder effect looks at: optical depth towards the sun, or extinction at the place"},
    {"optical_depth.g", simple<&Settings::g>, from_to(-1, 1), "",
     "mean cosine of a henyey-greenstein function instead of the media's phase functions; left "
     "out: those",
     kNoNote},
    {"optical_depth.resolution", simple<&Settings::resolution>, from_to(0, 4096), "cells",
     "of the buffer of optical depths; 0: as many as the medium has"},
    {"optical_depth.buffer", simple<&Settings::exact>, one_of("swept|exact"), "",
     "optical depths by a sweep from slice to slice, or by a ray for each cell"},
    {"optical_depth.light_scale", simple<&Settings::light_scale>, from_to(0, 1e6), "",
     "factor on the extinction towards the sun alone"},
    {"optical_depth.max_extinction_per_m", simple<&Settings::max_extinction_per_m>, from_to(0, 1e9),
     "1/m", "larger extinctions become this one; 0: none does"},
    {"optical_depth.steps", simple<&Settings::steps>, from_to(0, 65536), "",
     "most steps of a ray through the medium, one sample each; 0: each as long as a cell"},
    {"optical_depth.stop_below", simple<&Settings::stop_below>, from_to(0, 1), "",
     "light of a ray ends where less of what lies behind is seen"},
};

}  // namespace

Span<const KeyRow> optical_depth_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
