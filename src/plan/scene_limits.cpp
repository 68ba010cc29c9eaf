// SPDX-License-Identifier: Apache-2.0
// See scene_limits.h.
#include "src/plan/scene_limits.h"

#include "src/scene/media/transfer.h"

namespace pileus {

Status check_scene_limits(const Scene& scene, const Limits& limits) {
    const auto& size = scene.camera.resolution;
    const std::pair<LimitId, std::uint64_t> needs[] = {
        {LimitId::kText, scene.text.size()},
        {LimitId::kMedia, media_by_colour(scene)},
        {LimitId::kPixels, std::uint64_t(size[0]) * std::uint64_t(size[1])},
        {LimitId::kFrames, scene.animation.present ? std::uint64_t(scene.animation.frames) : 1},
        {LimitId::kGenerations, std::uint64_t(scene.collectors.generations)},
        {LimitId::kSamples, std::uint64_t(scene.collectors.placement.samples)},
    };
    for (const auto& need : needs)
        PILEUS_TRY(check_limit(limits, need.first, need.second, scene.file));
    return Status::ok();
}

}  // namespace pileus
