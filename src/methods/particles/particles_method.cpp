// SPDX-License-Identifier: Apache-2.0
// See particles_method.h.
#include "src/methods/particles/particles_method.h"

#include "kernels_cpu/core/profile.h"
#include "src/base/digest.h"
#include "src/methods/check_support.h"
#include "src/methods/particles/particles_run.h"
#include "src/picture/air_view.h"
#include "src/picture/background.h"
#include "src/picture/finish_frame.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/world/camera/view.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

ParticlesRun& own(MethodRun& run) { return static_cast<ParticlesRun&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<ParticlesRun>(); }

Status check(const Scene& scene, const Budget& budget) {
    const bool bins = !scene.particles.billboards && budget.steps >= 0;
    if (bins && (budget.steps == 0 || budget.steps > kMostParticleBins))
        return Status::bad_input("--budget steps: out of range, " + std::to_string(budget.steps) +
                                 ", allowed: 1 to " + std::to_string(kMostParticleBins) +
                                 " for method particles");
    PILEUS_TRY(check_budget_kinds(scene, budget));
    if (!shows_particles(scene))
        return Status::bad_input(scene.file +
                                 ": medium: method particles shows one medium of particles, " +
                                 std::to_string(scene.media.size()) +
                                 " media, allowed: one [[medium]] whose density is a file of "
                                 "particles (.ply, .csv, .prt, .bgeo, .pdb, .pda) or "
                                 "procedural:plume, procedural:particle-cumulus");
    if (scene.media[0].periodic)
        return Status::bad_input(scene.file +
                                 ": medium.0.boundary: method particles shows each particle once, "
                                 "\"periodic\", allowed: left out");
    return check_layer_kinds(scene);
}

void choose_light(const SunPlace& sun, ParticlesRun& run) {
    run.lighting = light_of(*run.scene, sun, *run.world, run.environment);
    choose_orders(run);
}

Status outline(const Context& context, MethodRun& method_run) {
    ParticlesRun& run = own(method_run);
    if (kDevices && context.kernels->device != nullptr)
        return Status::bad_input(std::string("--isa: \"") + context.kernels->name +
                                 "\": method particles runs on the host alone, allowed: another, "
                                 "or another method");
    run.settings = run.scene->particles;
    choose_light(run.sun_of(0), run);
    return plan_particles(context, run);
}

/// The digest of what the kernels read.
std::string digest_of(const ParticleTree& tree) {
    Digest digest;
    for (const ParticleBall& ball : tree.balls.span()) {
        const float numbers[] = {ball.centre[0], ball.centre[1], ball.centre[2], ball.per_radius,
                                 ball.depth};
        digest.floats({numbers, 5});
    }
    return digest.hex();
}

Status prepare(const Context& context, MethodRun& method_run) {
    ParticlesRun& run = own(method_run);
    choose_light(run.sun_of(0), run);
    PILEUS_TRY(make_majorants(run.world->medium, false, context, run.majorants));
    {
        const StageClock clock(context, "octree");
        const ParticleSet& set = run.world->particles;
        PILEUS_TRY(make_particle_tree(set, run.world->medium.low_m, run.settings.leaf,
                                      context.threads, run.tree));
    }
    run.particles = run.tree.balls.size();
    run.outlined_only = false;
    if (kPlans && context.digests)
        run.digests = {{"density", density_digest(*run.world)}, {"particles", digest_of(run.tree)}};
    return plan_particles(context, run);
}

Status fill_background(const Context& context, ParticlesRun& run) {
    const StageClock clock(context, "background");
    const BackgroundParams k = background_params(make_medium_view(run.world->medium, run.majorants),
                                                 run.camera, run.lighting);
    const BackgroundBuffers b{nullptr, run.planes.background.data(),
                              run.planes.opaque_depth.data()};
    return show_background(context, run.lighting, k, b);
}

/// The grid dims light on its way to the ground, as it does the sun's.
Status light_ground_by_lamps(const Context& context, ParticlesRun& run) {
    if (run.lighting.lamps.empty() || !run.lighting.ground) return Status::ok();
    LampNodes lamps;
    lamps.lamps = run.lighting.lamps;
    const Medium& medium = run.world->medium;
    LampMarchParams k =
        lamp_march_params(medium, run.majorants, run.lighting, run.camera, lamps, 0);
    k.media = 0;
    return add_lamp_light(context, medium, k, lamps, run.planes);
}

Status light(const FrameStep& step, const Context& context, MethodRun& method_run) {
    ParticlesRun& run = own(method_run);
    const Scene& scene = *run.scene;
    run.lighting = light_of(scene, run.sun_of(step.frame), *run.world, run.environment);
    run.camera = make_camera(scene.camera, orbit_at(scene, step.frame), run.world->medium.low_m);
    PILEUS_TRY(light_particles(context, run));
    PILEUS_TRY(allocate_planes(run.camera.width, run.camera.height, 3, run.lighting.opaque(),
                               scene.wants_depth(), run.planes));
    if (kFilms && scene.output.layer_optical_depth)
        PILEUS_TRY(allocate(arrays::picture_planes(1, run.planes.transmittance.size()),
                            run.planes.optical_depth));
    PILEUS_TRY(fill_background(context, run));
    PILEUS_TRY(show_particles(context, run));
    if (kFilms && scene.output.layer_occlusion) PILEUS_TRY(show_occlusion(context, run));
    PILEUS_TRY(light_ground_by_lamps(context, run));
    return show_air(context, scene, run.world->medium, run.lighting, run.camera, run.environment,
                    run.planes);
}

Status show(const FrameStep&, const Context& context, MethodRun& method_run, Image& image) {
    ParticlesRun& run = own(method_run);
    context.report->digests = run.digests;
    FinishedParts parts;
    parts.colours = true;
    parts.media = false;
    return finish_frame(context, run.scene->output, *run.world, run.environment.depth, run.camera,
                        parts, run.planes, image, *context.report);
}

/// Light is made again by the next picture where what shines has changed.
Status aim(int, bool anew, const Context&, MethodRun& method_run) {
    ParticlesRun& run = own(method_run);
    const Lighting before = run.lighting;
    choose_light(place_of(run.scene->sun), run);
    if (anew || !same_shine(before, run.lighting)) run.lit = false;
    return Status::ok();
}

Status advance(std::uint64_t, const Context&, MethodRun&, std::uint64_t& done) {
    done = 0;
    return Status::ok();
}

LightUnits units(const MethodRun&) { return {}; }

Status compose(const FrameStep& step, const Context& context, MethodRun& method_run,
               Planes*& planes) {
    planes = &own(method_run).planes;
    return light(step, context, method_run);
}

FrameWork full_work(const MethodRun& run) {
    FrameWork out;
    const ParticlesSettings& s = static_cast<const ParticlesRun&>(run).settings;
    if (!s.billboards) out.steps = run.budget.steps >= 0 ? int(run.budget.steps) : s.bins;
    return out;
}

Status set_limits(const FrameWork& work, MethodRun& run) {
    if (work.steps > 0) own(run).settings.bins = work.steps;
    return Status::ok();
}

void put_tables(const FrameWork& work, const MethodRun&, MethodTables& tables) {
    if (work.steps > 0) tables.particles.bins = work.steps;
}

Status most_units(const FrameWork&, const MethodRun&, FrameUnits&) {
    return Status::bad_input(
        "units: what method particles takes depends on the view, allowed: another method");
}

constexpr LiveMethod kLive{
    aim, advance, units, compose, full_work, set_limits, kept(kChecks, put_tables), most_units};

void count(const MethodRun&, Counts& counters) {
    counters.emplace_back("majorant_violations", 0);  // the grid only casts shadows
}

void report_run(const MethodRun& method_run, Report& report) {
    const ParticlesRun& run = static_cast<const ParticlesRun&>(method_run);
    report.executed.emplace_back("particles", run.particles);
    report.executed.emplace_back("octree_nodes", std::uint64_t(run.tree.count()));
    report.executed.emplace_back("octree_leaves", run.tree.leaves);
}

}  // namespace

Status ParticlesRun::reserve(LateRows&) {
    PILEUS_TRY(reserve_depths(scene->camera.resolution,
                              lighting.opaque() || environment.depth.present, planes));
    const std::size_t lamps = scene->lights.size(), count = tree.balls.size();
    if (lamps == 0) return Status::ok();
    const Array<float> depths = arrays::particle_lamps(count, lamps),
                       light = arrays::particle_around(count);
    PILEUS_TRY(lamp_depth.reserve(depths.count, depths.name));
    PILEUS_TRY(lamp_reach.reserve(depths.count, depths.name));
    return around_balls.reserve(light.count, light.name);
}

const Recipe& particles_method() {
    static constexpr Recipe method{"particles",
                                   WorldUse::kParticles,
                                   make,
                                   kept(kChecks, check),
                                   outline,
                                   prepare,
                                   kept(kFilms, light),
                                   kept(kFilms, show),
                                   count,
                                   kept(kPlans, report_run),
                                   nullptr,
                                   &kLive};
    return method;
}

}  // namespace pileus
