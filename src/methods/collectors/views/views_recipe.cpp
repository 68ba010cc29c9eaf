// SPDX-License-Identifier: Apache-2.0
// Each view as a recipe, so that views go through the same loop over frames as pictures.
// in: View -> out: Recipe.
// docs/how-it-works.md
#include "src/methods/collectors/views/views.h"
#include "src/photons/photon_frames.h"

namespace pileus {
namespace {

ViewRun& own(MethodRun& run) { return static_cast<ViewRun&>(run); }
const ViewRun& own(const MethodRun& run) { return static_cast<const ViewRun&>(run); }

template <View kView>
std::unique_ptr<MethodRun> make() {
    return std::make_unique<ViewRun>(kView);
}

Status check(const Scene& scene, const Budget& budget) {
    return collectors_method().check(scene, budget);
}

Status outline(const Context& context, MethodRun& run) {
    return collectors_view_outline(context, own(run));
}

Status prepare(const Context& context, MethodRun& run) {
    return collectors_view_prepare(context, own(run));
}

/// Only the light of collectors needs photons that stay.
Status light(const FrameStep& step, const Context& context, MethodRun& run) {
    if (own(run).view != View::kIllumination) return Status::ok();
    return collectors_light(step, context, own(run));
}

Status show(const FrameStep& step, const Context& context, MethodRun& run, Image& image) {
    return collectors_view_show(orbit_at(own(run).shown, step.frame), context, own(run), image);
}

void count(const MethodRun& run, Counts& counters) { collectors_view_count(own(run), counters); }

void report(const MethodRun& run, Report& out) { collectors_view_report(own(run), out); }

template <View kView>
constexpr Recipe recipe(const char* name) {
    return {name,
            WorldUse::kGrid,
            make<kView>,
            check,
            outline,
            prepare,
            light,
            show,
            count,
            report,
            photon_budget_used,
            nullptr,
            view_is_light(kView)};
}

}  // namespace

const Recipe* collectors_views(int& count) {
    static constexpr Recipe all[] = {recipe<View::kDensitySlice>("density-slice"),
                                     recipe<View::kGradientSlice>("gradient-slice"),
                                     recipe<View::kGradient>("gradient"),
                                     recipe<View::kSamples>("samples"),
                                     recipe<View::kTree>("tree"),
                                     recipe<View::kLeafDensity>("leaf-density"),
                                     recipe<View::kCollectors>("collectors"),
                                     recipe<View::kPhotons>("photons"),
                                     recipe<View::kIllumination>("illumination")};
    count = int(sizeof all / sizeof all[0]);
    return all;
}

}  // namespace pileus
