// SPDX-License-Identifier: Apache-2.0
// Keys of method `path`, and of the filter of its pictures.
// in: checked values <-> out: fields of PathSettings, FilterSettings.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField path = field<&Scene::path, Members...>;
template <auto... Members>
constexpr KeyField filter = field<&Scene::filter, Members...>;

constexpr KeyRow kRows[] = {
    {"path.samples_per_pixel", path<&PathSettings::samples_per_pixel>, from_to(1, 0x1p32), "",
     "paths for each pixel"},
    {"path.max_depth", path<&PathSettings::max_depth>, from_to(0, 1000000), "",
     "scatterings after which light is not followed; 0: unlimited, without bias"},
    {"path.pixel", path<&PathSettings::centre>, one_of("box|centre"), "",
     "where a pixel's rays go: spread evenly over it, or all through its centre, as "
     "the other methods send theirs"},
    {"path.guide", path<&PathSettings::guide>, any(), "",
     "seeks the sun's light by branches near its direction where a phase function is peaked"},
    {"path.importance", path<&PathSettings::importance>, one_of("auto|true|false"), "",
     "splits paths where discrete ordinates expect much light and ends them where they expect "
     "little, without bias: true wherever they know the scene (one medium of Henyey-Greenstein's "
     "phase function and one albedo), auto where g is 0.75 or more and the picture takes 8 million "
     "samples or more, so that it pays"},
    {"path.target_error", path<&PathSettings::target_error>, from_to(0, 1), "",
     "ends where the standard error over the radiance, its mean over the cloud's "
     "pixels, is no more than this; 0: after samples_per_pixel"},
    {"path.max_samples_per_pixel", path<&PathSettings::max_samples_per_pixel>, from_to(1, 0x1p32),
     "", "the most where target_error or --budget error or seconds decides"},
};

constexpr KeyRow kFilterRows[] = {
    {"filter.kind", filter<&FilterSettings::kind>, one_of("none|regression|oidn"), "",
     "what takes the noise out of a picture of method path: local regressions on what is known of "
     "each pixel without noise, with a small bias; oidn: the library Open Image Denoise, to "
     "compare "
     "with, in other bits on other machines; none: the picture stays unbiased"},
    {"filter.radius_pixels", filter<&FilterSettings::radius_pixels>, from_to(0, 512), "",
     "radius of the windows of the regressions; 0: chosen place by place, by the noise"},
};

}  // namespace

Span<const KeyRow> path_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }
Span<const KeyRow> filter_keys() {
    return {kFilterRows, sizeof kFilterRows / sizeof kFilterRows[0]};
}

}  // namespace pileus
