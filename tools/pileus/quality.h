// SPDX-License-Identifier: Apache-2.0
// `--quality`: settings for a first look, or for a last picture, by method.
// in: the scene as read -> out: overrides, as after --set.
// docs/program.md
#pragma once
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace pileus {

/// The overrides of "draft" or "final" for this scene, but for keys that `sets` has. kBadInput:
/// another word.
Status quality_sets(const std::string& quality, const Scene& scene,
                    const std::vector<std::string>& sets, std::vector<std::string>& out);

}  // namespace pileus
