// SPDX-License-Identifier: Apache-2.0
// See particles_method.h.
#include "src/methods/particles/particles_method.h"

#include "src/picture/background.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/picture/ordinates/ordinate_ground.h"
#include "src/picture/whole_rays.h"

namespace pileus {
namespace {

Status fill_background(const Context& context, const FrameView& view, ParticlesState& state) {
    const StageClock clock(context, "background");
    BackgroundParams k = background_params(make_medium_view(view.world.medium, state.majorants),
                                           state.camera, view.lighting);
    BackgroundBuffers b{nullptr, state.planes.background.data(), state.planes.opaque_depth.data()};
    if (by_ordinates(state)) read_ordinate_light(state.ordinates, view.lighting, k, b);
    return show_background(context, view.lighting, k, b);
}

/// The grid dims light on its way to ground and solids, as it does the sun's.
Status light_surfaces_by_lamps(const Context& context, const FrameView& view,
                               ParticlesState& state) {
    const Solids& solids = view.world.solids;
    if (view.lighting.lamps.empty() || !(view.lighting.ground.present || solids.meshes))
        return Status::ok();
    LampNodes lamps;
    lamps.lamps = view.lighting.lamps;
    const Medium& medium = view.world.medium;
    LampMarchParams k =
        lamp_march_params(medium, state.majorants, view.lighting, state.camera, lamps, 0);
    k.media = 0;
    if (by_ordinates(state)) std::copy_n(state.ordinates.mean_rest, 3, k.surface_rest);
    k.solids = solids.view();
    return add_lamp_light(context, medium, k, lamps, state.planes);
}

MadeMethod make(const MethodInputs& inputs) {
    auto method = std::make_unique<ParticlesMethod>(inputs);
    MadeMethod made;
    made.report = particles_report(*method);
    made.method = std::move(method);
    return made;
}

}  // namespace

ParticlesMethod::ParticlesMethod(const MethodInputs& inputs) {
    state_.settings = inputs.scene.particles;
    state_.settings.light = light_in_use(state_.settings);
    state_.settings.scattering = scattering_in_use(state_.settings);
    state_.hosted = inputs.live;
    if (inputs.live) state_.settings.stop_below = host_stop(state_.settings.stop_below);
    if (inputs.budget.steps > 0) state_.settings.bins = int(inputs.budget.steps);
}

Status ParticlesMethod::plan(const Context&, const FrameView& view, Plan&) {
    choose_orders(view, state_);
    return Status::ok();
}

Status ParticlesMethod::prepare(const Context& context, const FrameView& view) {
    const Medium& medium = view.world.medium;
    PILEUS_TRY(make_majorants(medium, false, context, state_.majorants));
    if (state_.settings.scattering == ParticleScattering::kByNodes && medium.sigma > 0)
        PILEUS_TRY(
            prepare_ordinates(context, medium, state_.majorants, ordinate_solids(view.lighting),
                              state_.hosted || !view.scene.lights.empty(), state_.ordinates));
    const StageClock clock(context, "octree");
    PILEUS_TRY(make_particle_tree(view.world.particles, medium.low_m, state_.settings.leaf,
                                  context.threads, state_.tree));
    state_.particles = state_.tree.balls.size();
    state_.outlined_only = false;
    return Status::ok();
}

Status ParticlesMethod::reserve(const FrameView& view, LateRows&) {
    ParticlesState& s = state_;
    PILEUS_TRY(reserve_depths(view.scene.camera.resolution,
                              view.lighting.opaque() || view.environment.depth.present, s.planes));
    if (by_ordinates(s)) PILEUS_TRY(reserve_ordinates(s.ordinates));
    const std::size_t lamps = view.scene.lights.size(), count = s.tree.balls.size();
    if (lamps == 0) return Status::ok();
    const Array<float> depths = arrays::particle_lamps(count, lamps),
                       light = arrays::particle_around(count);
    PILEUS_TRY(s.lamp_depth.reserve(depths.count, depths.name));
    PILEUS_TRY(s.lamp_reach.reserve(depths.count, depths.name));
    s.lamps.reserve(lamps);
    return s.around_balls.reserve(light.count, light.name);
}

/// Light is made again by the next picture where what shines has changed.
Status ParticlesMethod::set_view(const Context&, const FrameView& view, const ViewChange& change) {
    if (change.new_sky || change.new_shine) state_.lit = false;
    choose_orders(view, state_);
    return Status::ok();
}

Status ParticlesMethod::accumulate(const Context&, const FrameView&, std::uint64_t,
                                   std::uint64_t& done) {
    done = 0;
    return Status::ok();
}

Status ParticlesMethod::render(const Context& context, const FrameView& view, const RenderAsk&,
                               Planes*& out) {
    const Scene& scene = view.scene;
    Planes& planes = state_.planes;
    out = &planes;
    state_.camera = view.camera;
    PILEUS_TRY(light_particles(context, view, state_));
    PILEUS_TRY(allocate_planes(state_.camera.width, state_.camera.height, 3, view.lighting.opaque(),
                               view.wants_depth(), planes));
    if (scene.output.layer_optical_depth)
        PILEUS_TRY(
            allocate(arrays::picture_planes(1, planes.transmittance.size()), planes.optical_depth));
    PILEUS_TRY(fill_background(context, view, state_));
    PILEUS_TRY(show_particles(context, view, state_));
    return light_surfaces_by_lamps(context, view, state_);
}

FrameWork ParticlesMethod::full_work() const {
    FrameWork out;
    if (!state_.settings.billboards) out.steps = state_.settings.bins;
    return out;
}

Status ParticlesMethod::set_limits(const FrameWork& work) {
    if (work.steps > 0) state_.settings.bins = work.steps;
    return Status::ok();
}

Status ParticlesMethod::worst_case(const FrameView&, const FrameWork&, FrameUnits&) const {
    return Status::bad_input(
        "units: what method particles takes depends on the view, allowed: another method");
}

void ParticlesMethod::count(Counts& counts) const {
    counts.emplace_back("majorant_violations", 0);  // the grid only casts shadows
}

MethodRow particles_row() { return {"particles", WorldUse::kParticles, check_particles, make}; }

}  // namespace pileus
