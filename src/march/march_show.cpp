// SPDX-License-Identifier: Apache-2.0
// One frame of a raymarch: sunlight, background, march, layers.
// in: a prepared RaymarchRun -> out: Image, Report.
// docs/raymarch.md; docs/formats.md, "Pictures out"
#include <algorithm>

#include "kernels_cpu/core/profile.h"
#include "platform/clock.h"
#include "src/base/angles.h"
#include "src/march/march_budget.h"
#include "src/march/march_parts.h"
#include "src/picture/air_view.h"
#include "src/picture/background.h"
#include "src/picture/blue_noise.h"
#include "src/picture/finish_frame.h"
#include "src/picture/late_rows.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/picture/nodes/solid_shadow.h"

namespace pileus {
namespace {

constexpr std::uint64_t kComparedNodes = 1024;

SunTurn turn_of(const RaymarchRun& run) {
    return turn_of_sun(run, run.settings.light_refresh, run.turn, run.lighting.to_sun);
}

/// Nodes serve every frame of the same sun; a sweep is made whole for each.
Status light_nodes(const Context& context, RaymarchRun& run) {
    if (run.march_light || !run.lighting.sunlit || run.world->medium.sigma <= 0)
        return Status::ok();
    const auto& to_sun = run.lighting.to_sun;
    PILEUS_TRY(make_lit_medium(context, run));
    const bool apart = !run.lit.volume.density.empty();
    const Medium& medium = apart ? run.lit : marched_medium(run);
    const Majorants& majorants = apart ? run.lit_majorants : run.majorants;
    if (run.settings.light != RaymarchLightKind::kBuffer) {
        // Coarser densities reach farther than the medium's own.
        const MediumView view =
            run.levels > 0 ? MediumView{} : make_medium_view(run.world->medium, run.majorants);
        return follow_sun_depth(context, medium, majorants, view, turn_of(run), run.slices,
                                run.nodes);
    }
    if (!run.nodes.optical_depth.empty() && run.nodes_to_sun == to_sun) return Status::ok();
    PILEUS_TRY(make_sun_depth(context, medium, majorants, to_sun, SunDepthKind::kSwept, run.nodes));
    // A thousand rays tell what the sweep smears.
    run.nodes_difference = {};
    if (run.nodes.swept)
        PILEUS_TRY(sun_depth_difference(context, medium, majorants, to_sun, run.nodes,
                                        kComparedNodes, run.nodes_difference));
    run.nodes_to_sun = run.lighting.to_sun;
    return Status::ok();
}

/// Whether nodes are seen from the same place, or along the same direction; or, from outside,
/// nearly so as seen from the middle of the box.
bool same_way(const RaymarchRun& run, const CameraParams& a, const CameraParams& b) {
    const bool flat = a.orthographic != 0;
    const float* from = flat ? a.forward : a.origin;
    const float* to = flat ? b.forward : b.origin;
    if (a.orthographic != b.orthographic) return false;
    if (std::equal(from, from + 3, to)) return true;
    if (!kClouds || run.view_slack_deg <= 0 || flat) return false;
    double aa = 0, bb = 0, ab = 0, ball = 0;
    for (int i = 0; i < 3; ++i) {
        const double half = 0.5 * run.world->medium.extent_m[i];
        const double x = double(from[i]) - half, y = double(to[i]) - half;
        aa += x * x, bb += y * y, ab += x * y, ball += half * half;
    }
    const double least = sincos_deg(run.view_slack_deg).cosine;
    return aa > 2 * ball && bb > 2 * ball && ab > 0 && ab * ab > least * least * aa * bb;
}

/// Light of sky and ground changes with the sun, and with the camera where that is known.
Status light_sky(const Context& context, const FrameStep& step, RaymarchRun& run) {
    if (!run.settings.sky_ambient || run.world->medium.sigma <= 0) return Status::ok();
    const SkyView view = sky_view(run);
    const bool seen = !view.turned || same_way(run, run.sky_camera, run.camera);
    const bool same = seen && run.sky_to_sun == run.lighting.to_sun;
    if (!step.first && run.sky_made && same) return Status::ok();
    run.sky_made = false;
    run.sky_to_sun = run.lighting.to_sun;
    run.sky_camera = run.camera;
    PILEUS_TRY(make_sky_nodes(context, run.world->medium, run.majorants, run.lighting,
                              mean_kept(run.settings, run.world->medium), octaves_of(run.settings),
                              view, run.sky));
    run.sky_made = true;
    return Status::ok();
}

/// Light of [[light]], scattered once or by octaves, and of the media: its own march, in steps of
/// the grid.
Status add_lamps(const Context& context, RaymarchRun& run) {
    const Medium& medium = marched_medium(run);
    if ((run.lighting.lamps.empty() && !emits(medium)) || run.settings.steps == 0)
        return Status::ok();
    PILEUS_TRY(make_lamp_nodes(context, medium, run.majorants, run.lighting, run.lamps));
    return add_lamp_light(context, medium, march_lamps(run), run.lamps, run.planes);
}

/// The shadow of solids, on nodes two voxels apart.
Status shade_by_solids(const Context& context, RaymarchRun& run) {
    if (!kMeshes || !run.world->solids.meshes || !run.lighting.sunlit ||
        run.world->medium.sigma <= 0)
        return Status::ok();
    float coarse = 0;
    for (float cell : run.world->medium.grid.cell_m) coarse = cell > coarse ? cell : coarse;
    run.visibility_nodes =
        make_node_grid(run.world->medium.grid, run.world->medium.extent_m, 2 * double(coarse));
    return solid_visibility(context, run.world->solids, run.visibility_nodes, run.lighting.to_sun,
                            run.visibility);
}

/// Parts need the whole background, a trial for a budget of seconds any row's depths.
LateRows* late_march(const FrameStep& step, const RaymarchRun& run) {
    const OutputSettings& output = run.scene->output;
    if (kFilms && (output.layer_light || output.layer_order || run.budget.seconds > 0))
        return nullptr;
    return late_rows_of(step.late, run.lighting, run.world->medium, run.settings.thin, run.camera,
                        step.frame);
}

}  // namespace

SkyView sky_view(const RaymarchRun& run) {
    SkyView view;
    const World& world = *run.world;
    view.turned = run.simple == nullptr && !world.medium.grid.periodic &&
                  !(world.direct_sky && world.layer.params.boxed == 0);
    view.camera = run.camera;
    view.anisotropy = float(run.settings.octave_anisotropy);
    return view;
}

LampMarchParams march_lamps(const RaymarchRun& run) {
    const Medium& medium = marched_medium(run);
    LampMarchParams k = lamp_march_params(medium, run.majorants, run.lighting, run.camera,
                                          run.lamps, run.settings.stop_below);
    k.octaves = octaves_of(run.settings);
    set_octaves(run.settings, medium, k.albedo, k.octave_g, k.octave_source);
    k.octave_depths = octave_depths(k.octaves, medium);
    for (int i = 0; i < k.media; ++i) {
        float unit = 1;
        if (run.settings.peak_phase) unit = 1.0f / phase_peak(k.phase[i]);
        if (run.simple != nullptr) {
            // As the sun's light in this method: twice, and with a phase function of its own.
            if (run.simple->g >= -1) k.phase[i] = {kPhaseHg, float(run.simple->g), 0, 1};
            unit = float(2 * run.simple->intensity);
        }
        for (float& albedo : k.albedo[i]) albedo *= unit;
    }
    return k;
}
Status march_background(const Context& context, const Lighting& light, RaymarchRun& run,
                        Planes& planes) {
    if (kClouds && run.alone) return show_nothing_behind(planes);
    const MediumView view = make_medium_view(run.world->medium, run.majorants);
    PILEUS_TRY(make_ground_shadow(context, run.world->medium, view, run.lighting,
                                  planes.transmittance.size(), turn_of(run), run.ground_shadow));
    const StageClock clock(context, "background");
    BackgroundParams k = background_params(view, run.camera, light);
    BackgroundBuffers b{nullptr, planes.background.data(), planes.opaque_depth.data()};
    read_ground_shadow(run.ground_shadow, k, b);
    if (planes.late != nullptr) return leave_background(context, k, b, *planes.late);
    return show_background(context, light, k, b);
}

Status march_light(const FrameStep& step, const Context& context, MethodRun& method_run) {
    RaymarchRun& run = static_cast<RaymarchRun&>(method_run);
    run.turn = step.frame;
    return march_frame(step, context, run);
}

Status march_frame(const FrameStep& step, const Context& context, RaymarchRun& run) {
    const Scene& scene = *run.scene;
    const OutputSettings& output = scene.output;
    const double start_s = wall_seconds();
    {
        const StageClock clock(context, "lights");
        run.lighting = light_of(scene, run.sun_of(step.frame), *run.world, run.environment);
        run.camera =
            make_camera(scene.camera, orbit_at(scene, step.frame), run.world->medium.low_m);
    }
    if (run.settings.jitter == RaymarchJitterKind::kBlueNoise && run.noise.empty())
        PILEUS_TRY(make_blue_noise(run.noise));
    PILEUS_TRY(light_nodes(context, run));
    if (kMeshes) PILEUS_TRY(shade_by_solids(context, run));
    PILEUS_TRY(light_sky(context, step, run));
    {
        // Clearing memory is part of it.
        const StageClock clock(context, "background");
        PILEUS_TRY(allocate_planes(run.camera.width, run.camera.height, 3, run.lighting.opaque(),
                                   scene.wants_depth(), run.planes));
        if (kFilms && output.layer_optical_depth)
            PILEUS_TRY(allocate(arrays::picture_planes(1, run.planes.transmittance.size()),
                                run.planes.optical_depth));
    }
    run.planes.late = late_march(step, run);
    PILEUS_TRY(march_background(context, run.lighting, run, run.planes));
    RaymarchInput in;
    in.medium = &marched_medium(run);
    in.majorants = &run.majorants;
    in.lighting = &run.lighting;
    in.settings = &run.settings;
    in.simple = run.simple;
    in.nodes = &run.nodes;
    in.visibility_nodes = run.visibility_nodes;
    in.visibility = run.visibility.data();
    in.sky = &run.sky;
    in.levels = &run.coarse;
    in.march_light = run.march_light;
    in.noise = &run.noise;
    // Frame f of an animation has the jitter of the seed f further on.
    in.seed = std::uint64_t(scene.seed) + std::uint64_t(step.frame);
    in.layer = run.world->direct_sky ? &run.world->layer : nullptr;
    in.camera = run.camera;
    UpsampleInput thin;
    thin.camera = run.camera;
    thin.medium = make_medium_view(*in.medium, run.majorants);
    thin.to_sun = run.lighting.to_sun;
    thin.march = [&](const PixelLattice& lattice, Planes& planes) {
        in.lattice = lattice;
        return raymarch_picture(context, in, planes, run.tally);
    };
    if (run.sky_nodes && run.lighting.sunlit && run.world->medium.sigma > 0) {
        PILEUS_TRY(follow_sky_light(context, raymarch_params(in), run.world->layer.params,
                                    sky_light_bits(run), kNearSteps, turn_of(run), run.sky_light));
        in.sky_light = &run.sky_light.view;
    }
    if (kFilms) PILEUS_TRY(choose_march_work(context, start_s, thin, run));
    thin.settings = run.settings.thin;
    PILEUS_TRY(upsample_picture(context, thin, step.frame, run.upsample, run.planes));
    PILEUS_TRY(add_lamps(context, run));
    if (kFilms) PILEUS_TRY(march_parts(context, in, run));
    return show_air(context, scene, run.world->medium, run.lighting, run.camera, run.environment,
                    run.planes);
}

Status march_show(const FrameStep&, const Context& context, MethodRun& method_run, Image& image) {
    RaymarchRun& run = static_cast<RaymarchRun&>(method_run);
    context.report->digests = run.digests;
    FinishedParts parts;
    parts.colours = true;
    return finish_frame(context, run.scene->output, *run.world, run.environment.depth, run.camera,
                        parts, run.planes, image, *context.report);
}

void march_count(const MethodRun& method_run, Counts& counters) {
    const RaymarchRun& run = static_cast<const RaymarchRun&>(method_run);
    counters.emplace_back("majorant_violations", 0);  // bounds only say where nothing is
    counters.emplace_back("bound_breaches", run.tally.breaches);
    counters.emplace_back("rays_cut", run.tally.cut);
}

void march_report(const MethodRun& method_run, Report& report) {
    const RaymarchRun& run = static_cast<const RaymarchRun&>(method_run);
    report.executed.emplace_back("density_levels", run.coarse.size());
    report.executed.emplace_back("marched_pixels", run.upsample.marched);
    report.executed.emplace_back("recalled_pixels", run.upsample.recalled);
    report.executed.emplace_back("ray_samples", run.tally.samples);
    report.executed.emplace_back("light_samples", run.tally.light_samples);
    report.executed.emplace_back("sky_light_nodes", run.sky_light.made);
    report.executed.emplace_back("sky_light_samples", run.sky_light.densities);
    report.sweep = run.nodes_difference;
}

}  // namespace pileus
