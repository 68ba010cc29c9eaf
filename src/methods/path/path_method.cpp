// SPDX-License-Identifier: Apache-2.0
// See path_method.h. Preparation; path_light.cpp traces, path_show.cpp makes the picture.
#include "src/methods/path/path_method.h"

#include "src/world/plan_parts.h"

namespace pileus {
namespace {

MadeMethod make(const MethodInputs& inputs) {
    MadeMethod made;
    make_path(inputs, made);
    return made;
}

}  // namespace

PathMethod& make_path(const MethodInputs& inputs, MadeMethod& made) {
    auto method = std::make_unique<PathMethod>(inputs);
    PathMethod& path = *method;
    made.report = path_report(path, inputs.budget);
    made.method = std::move(method);
    return path;
}

PathMethod::PathMethod(const MethodInputs& inputs) {
    state_.settings = inputs.scene.path;
    state_.filter = inputs.scene.filter;
    state_.live = inputs.live;
}

Status PathMethod::plan(const Context&, const FrameView& view, Plan&) {
    state_.camera = make_camera(view.scene.camera, 0, view.world.medium.low_m);
    state_.splits = why_no_importance(view) == nullptr;
    return Status::ok();
}

Status PathMethod::prepare(const Context& context, const FrameView& view) {
    PILEUS_TRY(make_majorants(view.world.medium, true, context, state_.majorants, kPathCosts));
    state_.importance.made = false;
    state_.importance.nodes = OrdinateNodes{};
    state_.outlined_only = false;
    return Status::ok();
}

Status PathMethod::reserve(const FrameView&, LateRows&) { return Status::ok(); }

/// A film shows one camera and one light.
Status PathMethod::set_view(const Context&, const FrameView& view, const ViewChange& change) {
    const Scene& scene = view.scene;
    const int width = state_.camera.width, height = state_.camera.height;
    state_.camera = view.camera;
    // Frame f of an animation has the noise of the seed f further on.
    state_.seed = std::uint64_t(scene.seed) + std::uint64_t(view.frame);
    state_.begun = false;
    if (change.new_sky || state_.camera.width != width || state_.camera.height != height)
        state_.scratch = PathScratch{};
    return Status::ok();
}

Status PathMethod::begin(const Context& context, const FrameView& view) {
    return begin_film(context, view, state_);
}

Status PathMethod::accumulate(const Context& context, const FrameView& view, std::uint64_t units,
                              std::uint64_t& done) {
    done = 0;
    state_.interrupted = false;
    if (!state_.begun) PILEUS_TRY(begin(context, view));
    if (units == 0) return Status::ok();
    state_.interrupted = context.stop();
    if (state_.interrupted) return Status::ok();
    const std::uint64_t before = state_.film.samples;
    const Status traced = trace_film(context, view, units, state_);
    done = state_.film.samples - before;
    return traced;
}

Status PathMethod::render(const Context& context, const FrameView& view, const RenderAsk&,
                          Planes*& planes) {
    if (!state_.begun) PILEUS_TRY(begin(context, view));
    planes = &state_.planes;
    return show_film(context, view, state_);
}

LightUnits PathMethod::progress() const {
    LightUnits out;
    out.unit = "sample";
    out.stage = "paths";
    out.whole = std::uint64_t(state_.settings.samples_per_pixel);
    out.unit_photons = std::uint64_t(state_.camera.width) * std::uint64_t(state_.camera.height);
    out.held = state_.begun ? state_.film.samples : 0;
    out.in_passes = true;
    out.part = state_.begun && state_.film.ahead > 0;
    out.interrupted = state_.interrupted;
    return out;
}

Status PathMethod::set_limits(const FrameWork&) { return Status::ok(); }

Status PathMethod::worst_case(const FrameView& view, const FrameWork&, FrameUnits& units) const {
    const auto& size = view.scene.camera.resolution;
    units.pixels = units.rays = std::uint64_t(size[0]) * std::uint64_t(size[1]);
    return Status::ok();
}

void PathMethod::count(Counts& counts) const {
    const PathTally all = tally_of(state_);
    counts.emplace_back("majorant_violations", std::uint64_t(all.majorant_violations));
    counts.emplace_back("saturated", 0);  // sums are doubles
    counts.emplace_back("terminated", std::uint64_t(all.terminated));
    counts.emplace_back("nan_samples", std::uint64_t(all.nan));
}

void PathMethod::release(Phase phase) {
    if (phase == Phase::kTraced) state_.scratch = PathScratch{};
    if (phase != Phase::kShown) return;
    state_.guides = FilterGuides{};
    state_.film.sum = Buffer<double>();
    state_.film.square = Buffer<double>();
}

MethodRow path_row() {
    return {"path", WorldUse::kGrid, check_path, make, true, true, Division::kPaths, true};
}

}  // namespace pileus
