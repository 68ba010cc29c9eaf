// SPDX-License-Identifier: Apache-2.0
// What programs ask of methods `raymarch` and `optical-depth` besides pictures.
// in: a scene -> out: settings of other qualities, what films depend on, what keys cannot say.
// docs/program.md, "Quality"
#include "src/methods/march/march_method.h"
#include "src/methods/method_tools.h"

namespace pileus {
namespace {

constexpr std::int64_t kDraftSteps = 96;

void raymarch_draft(const Scene& scene, std::vector<std::string>& sets) {
    const RaymarchSettings& s = scene.raymarch;
    sets.push_back(at_most_text("raymarch.steps", s.march.steps, kDraftSteps));
    if (may_thin(scene, s.thin)) sets.push_back("raymarch.scale=2");
}

void raymarch_whole(const Scene&, std::vector<std::string>& sets) {
    sets.push_back("raymarch.scale=1");
    sets.push_back("raymarch.temporal=0");
}

FilmMemory raymarch_memory(const MethodTables& tables) {
    return {keeps_pictures(tables.raymarch.thin, tables.raymarch.light.refresh), false};
}

}  // namespace

const MethodTools raymarch_tools{raymarch_draft, raymarch_whole, raymarch_memory, nullptr, false};
const MethodTools optical_depth_tools{nullptr, nullptr, nullptr, nullptr, true};

}  // namespace pileus
