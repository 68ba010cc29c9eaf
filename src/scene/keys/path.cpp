// SPDX-License-Identifier: Apache-2.0
// Keys of method `path`.
// in: checked values <-> out: fields of PathSettings.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField path = field<&Scene::path, Members...>;

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
    {"path.target_error", path<&PathSettings::target_error>, from_to(0, 1), "",
     "ends where the standard error over the radiance, its mean over the cloud's "
     "pixels, is no more than this; 0: after samples_per_pixel"},
    {"path.max_samples_per_pixel", path<&PathSettings::max_samples_per_pixel>, from_to(1, 0x1p32),
     "", "the most where target_error or --budget error or seconds decides"},
};

}  // namespace

Span<const KeyRow> path_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
