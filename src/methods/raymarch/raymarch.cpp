// SPDX-License-Identifier: Apache-2.0
// See raymarch.h. The march is src/march.
// in: scene, budget -> out: settings of the march.
// docs/raymarch.md
#include "src/methods/raymarch/raymarch.h"

#include "kernels_cpu/core/profile.h"
#include "src/march/march_run.h"

namespace pileus {
namespace {

std::unique_ptr<MethodRun> make() { return std::make_unique<RaymarchRun>(); }

Status check(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_marched(scene, budget));
    const RaymarchLightKind light = scene.raymarch.light;
    if (scene.raymarch.light_cone &&
        (light == RaymarchLightKind::kBuffer || light == RaymarchLightKind::kBufferExact))
        return Status::bad_input(scene.file +
                                 ": raymarch.light: nodes hold straight ways, not those of "
                                 "light_path = \"cone\", allowed: auto, march");
    return check_upsampling(scene, "raymarch", scene.raymarch.thin);
}

Status outline(const Context& context, MethodRun& method_run) {
    RaymarchRun& run = static_cast<RaymarchRun&>(method_run);
    run.settings = run.scene->raymarch;
    if (run.budget.steps >= 0) run.settings.steps = int(run.budget.steps);
    return march_outline(context, run);
}

}  // namespace

const Recipe& raymarch_method() {
    static constexpr Recipe method{"raymarch",
                                   WorldUse::kSkyInPlace,
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
