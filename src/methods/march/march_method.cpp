// SPDX-License-Identifier: Apache-2.0
// See march_method.h.
#include "src/methods/march/march_method.h"

namespace pileus {
namespace {

MadeMethod made_by(MarchChoice choice) {
    auto method = std::make_unique<MarchMethod>(std::move(choice));
    MadeMethod made;
    made.report = march_report(*method);
    made.method = std::move(method);
    return made;
}

MadeMethod make_raymarch(const MethodInputs& inputs) { return made_by(raymarch_choice(inputs)); }

MadeMethod make_optical_depth(const MethodInputs& inputs) {
    return made_by(optical_depth_choice(inputs));
}

}  // namespace

MarchMethod::MarchMethod(MarchChoice choice) { state_.choice = std::move(choice); }

Status MarchMethod::plan(const Context&, const FrameView& view, Plan&) {
    PILEUS_TRY(choose_scattering(view, state_.choice));
    choose_march(view, state_.choice);
    return Status::ok();
}

Status MarchMethod::prepare(const Context& context, const FrameView& view) {
    MarchMedia& media = state_.media;
    PILEUS_TRY(make_majorants(view.world.medium, false, context, media.majorants));
    media.outlined_only = false;
    PILEUS_TRY(cap_medium(view, state_));
    const RaymarchSettings& settings = state_.choice.settings;
    media.wide_sun = settings.scattering.ordinates &&
                     settings.light.kind != RaymarchLightKind::kBuffer && !view.world.direct_sky &&
                     has_wide_sun(view.world.medium);
    media.lit = Medium{};
    state_.light.sky.made = false;
    const bool nodes =
        settings.scattering.ordinates && settings.march.steps > 0 && view.world.medium.sigma > 0;
    if (nodes && view.world.direct_sky)
        PILEUS_TRY(prepare_sky_ordinates(context, view.world.medium, view.world.layer.params,
                                         state_.choice.hosted, state_.light.ordinates.sky));
    else if (nodes)
        PILEUS_TRY(prepare_ordinates(
            context, view.world.medium, media.majorants, ordinate_solids(view.lighting),
            may_have_lamps(view, state_.choice), state_.light.ordinates.nodes));
    return make_density_levels(marched_medium(view, state_), state_.choice.levels,
                               media.majorants.skip_block, context, media.coarse);
}

Status MarchMethod::reserve(const FrameView& view, LateRows&) {
    const auto& size = view.scene.camera.resolution;
    const bool solid = view.lighting.opaque() || view.environment.depth.present;
    const MarchChoice& choice = state_.choice;
    MarchLight& light = state_.light;
    PILEUS_TRY(reserve_depths(size, solid, state_.picture.planes));
    PILEUS_TRY(reserve_lamp_nodes(
        view.world.medium,
        view.scene.lights.size() * (choice.settings.scattering.ordinates ? 2 : 1), light.lamps));
    light.sun.slices.reserve();
    light.ground_shadow.slices.reserve();
    if (choice.look) return Status::ok();
    if (!light.ordinates.nodes.density.empty())
        PILEUS_TRY(reserve_march_ordinates(light.ordinates));
    if (!light.ordinates.sky.levels.empty()) PILEUS_TRY(reserve_sky_ordinates(light.ordinates.sky));
    // Fewer marched pixels have fewer nodes.
    if (choice.sky_nodes)
        PILEUS_TRY(reserve_sky_light(view.world.layer.params, kMaxSkyLightBits, light.sky.layer));
    return reserve_upsampling(choice.settings.thin, size, solid, state_.picture.upsample);
}

/// Nodes of sunlight and sky are made again by the next picture where their light has changed.
Status MarchMethod::set_view(const Context&, const FrameView& view, const ViewChange& change) {
    MarchPicture& picture = state_.picture;
    if (change.new_sky || change.new_shine || change.new_run) {
        state_.light.sky.made = false;
        if (!change.follows_sun) picture.upsample.ready = false;
    }
    if (change.new_run) {
        state_.light.sun.slices.held.clear();
        state_.light.ground_shadow.slices.held.clear();
    }
    const auto& size = view.scene.camera.resolution;
    const bool opaque = view.lighting.opaque();
    if (picture.size != size || picture.opaque != opaque) forget_pictures(picture.upsample);
    picture.size = size;
    picture.opaque = opaque;
    return Status::ok();
}

Status MarchMethod::accumulate(const Context&, const FrameView&, std::uint64_t,
                               std::uint64_t& done) {
    done = 0;
    return Status::ok();
}

Status MarchMethod::render(const Context& context, const FrameView& view, const RenderAsk& ask,
                           Planes*& planes) {
    // A host's pictures are counted, frames of a film have numbers.
    std::int64_t& turn = state_.light.turn;
    turn = state_.choice.hosted ? turn + 1 : view.frame;
    planes = &state_.picture.planes;
    return march_frame(context, view, ask, state_);
}

FrameWork MarchMethod::full_work() const {
    const MarchChoice& choice = state_.choice;
    FrameWork out;
    if (choice.look) {
        out.steps = choice.look->steps;
        return out;
    }
    out = work_of(choice.settings.thin);
    out.light_refresh = choice.settings.light.refresh;
    out.steps = choice.settings.march.steps;
    return out;
}

Status MarchMethod::set_limits(const FrameWork& work) {
    MarchChoice& choice = state_.choice;
    RaymarchSettings& settings = choice.settings;
    if (choice.look) {
        // One step a cell has no number.
        if (work.steps == 0) return Status::ok();
        settings.march.spacing = RaymarchSpacing::kUniform;
    } else {
        put_work(work, settings.thin);
        settings.light.refresh = work.light_refresh;
        choice.whole_thin = settings.thin;
    }
    settings.march.steps = work.steps;
    return Status::ok();
}

Status MarchMethod::worst_case(const FrameView& view, const FrameWork& work,
                               FrameUnits& units) const {
    return march_most_units(view, work, state_, units);
}

void MarchMethod::count(Counts& counts) const {
    const RaymarchTally& tally = state_.picture.tally;
    counts.emplace_back("majorant_violations", 0);  // bounds only say where nothing is
    counts.emplace_back("bound_breaches", tally.breaches);
    counts.emplace_back("rays_cut", tally.cut);
}

MethodRow raymarch_row() {
    return {"raymarch", WorldUse::kSkyInPlace, check_raymarch, make_raymarch};
}

MethodRow optical_depth_row() {
    return {"optical-depth", WorldUse::kGrid, check_optical_depth, make_optical_depth};
}

}  // namespace pileus
