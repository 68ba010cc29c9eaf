// SPDX-License-Identifier: Apache-2.0
// Keys of the picture's filter.
// in: checked values <-> out: fields of FilterSettings.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField filter = field<&Scene::filter, Members...>;

constexpr KeyRow kRows[] = {
    {"filter.kind", filter<&FilterSettings::kind>, one_of("none|regression|oidn"), "",
     "what takes the noise out of a picture of method path: local regressions on what is known of "
     "each pixel without noise, with a small bias; oidn: the library Open Image Denoise, to "
     "compare "
     "with, in other bits on other machines; none: the picture stays unbiased"},
    {"filter.radius_pixels", filter<&FilterSettings::radius_pixels>, from_to(0, 512), "",
     "radius of the windows of the regressions; 0: chosen place by place, by the noise"},
};

}  // namespace

Span<const KeyRow> filter_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
