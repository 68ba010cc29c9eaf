// SPDX-License-Identifier: Apache-2.0
// See optical_depth.h. The march is src/march.
// in: scene, budget -> out: settings of the march.
// docs/optical-depth.md
#include "src/methods/optical_depth/optical_depth.h"

#include "kernels_cpu/core/profile.h"
#include "src/march/march_run.h"

namespace pileus {
namespace {

std::unique_ptr<MethodRun> make() { return std::make_unique<RaymarchRun>(); }

Status check(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_marched(scene, budget));
    if (scene.optical_depth.max_extinction_per_m > 0 && scene.media.size() > 1)
        return Status::bad_input(scene.file +
                                 ": optical_depth.max_extinction_per_m: not with several media, "
                                 "allowed: 0, or a scene with one");
    return Status::ok();
}

Status outline(const Context& context, MethodRun& method_run) {
    RaymarchRun& run = static_cast<RaymarchRun&>(method_run);
    run.looks = run.scene->optical_depth;
    const OpticalDepthSettings& s = run.looks;
    const std::int64_t steps = run.budget.steps >= 0 ? run.budget.steps : s.steps;
    run.simple = &s;
    run.settings = RaymarchSettings{};
    run.settings.many = false;
    run.settings.spacing =
        steps > 0 || run.budget.steps == 0 ? RaymarchSpacing::kUniform : RaymarchSpacing::kVoxel;
    run.settings.steps = steps > 0 ? int(steps) : run.budget.steps == 0 ? 0 : 1;
    run.settings.light = s.exact ? RaymarchLightKind::kBufferExact : RaymarchLightKind::kBuffer;
    run.settings.ambient = s.ambient;
    run.settings.sky_ambient = false;
    run.settings.stop_below = s.stop_below;
    return march_outline(context, run);
}

}  // namespace

const Recipe& optical_depth_method() {
    static constexpr Recipe method{"optical-depth",
                                   WorldUse::kGrid,
                                   make,
                                   kept(kChecks, check),
                                   outline,
                                   march_prepare,
                                   kept(kFilms, march_light),
                                   kept(kFilms, march_show),
                                   march_count,
                                   kept(kPlans, march_report),
                                   kept(kPlans, march_budget_used),
                                   &live_march};
    return method;
}

}  // namespace pileus
