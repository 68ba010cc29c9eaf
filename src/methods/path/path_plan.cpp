// SPDX-License-Identifier: Apache-2.0
// Weighs a run of the path tracer: what it needs and leaves out, memory, work, limits.
// in: PathRun, outlined or prepared -> out: its plan; kLimit where something is too much.
// docs/report.md, "Plan"; docs/path.md
#include "kernels_cpu/core/profile.h"
#include "src/methods/path/path.h"
#include "src/methods/path/path_blocks.h"
#include "src/methods/path/path_passes.h"
#include "src/methods/path/path_state.h"
#include "src/picture/filter/filter_error.h"
#include "src/picture/filter/oidn.h"
#include "src/picture/filter/regression.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr Stage kUnused[] = {
    Stage::kSamples,     Stage::kTree,       Stage::kCollectors, Stage::kLeafGrid, Stage::kPhotons,
    Stage::kReconstruct, Stage::kBackground, Stage::kShadow,     Stage::kSplat,    Stage::kDisplay};

bool has_sky(const Lighting& light) {
    return light.map.columns > 0 || light.sky[0] > 0 || light.sky[1] > 0 || light.sky[2] > 0;
}

void note_sun(const Scene& scene, const PathRun& run, Plan& plan) {
    const bool moves = moves_sun(scene);
    if (!run.lighting.sunlit && !(moves && scene.sun.present)) {
        plan.leave_out("flights towards the sun",
                       scene.sun.present ? "below the ground's horizon, or dark" : "no sun");
        return;
    }
    plan.need("flights towards the sun");
    if (scene.sun.angular_radius_deg > 0)
        plan.need("the sun's disc");
    else
        plan.leave_out("the sun's disc", "sun.angular_radius_deg = 0");
    if (!run.settings.guide)
        plan.leave_out("branches towards the sun", "path.guide = false");
    else if (fit_guide(run.world->medium).on == 0)
        plan.leave_out("branches towards the sun", "no peaked phase function");
    else
        plan.need("branches towards the sun, weighed against scattering (MIS)");
}

void note_light(const Scene& scene, const PathRun& run, Plan& plan) {
    const Lighting& light = run.lighting;
    note_sun(scene, run, plan);
    if (!light.lamps.empty())
        plan.needed.push_back("flights towards " + std::to_string(light.lamps.size()) +
                              " lights of [[light]], near them from between vertices");
    else
        plan.leave_out("flights towards lights", "no [[light]]");
    if (emits(run.world->medium))
        plan.need("emission of the media at tentative collisions");
    else
        plan.leave_out("emission of the media", "no medium has any");
    if (light.map.columns > 0)
        plan.need("flights towards the sky map, weighed against scattering (MIS)");
    else
        plan.leave_out("flights towards the sky",
                       has_sky(light) ? "constant sky: paths that leave find it" : "no sky");
    if (light.ground)
        plan.need("bounces off the ground");
    else
        plan.leave_out("bounces off the ground", "no ground");
}

void note_parts(const Scene& scene, const PathRun& run, Plan& plan) {
    const OutputSettings& output = scene.output;
    if (path_parts(output))
        plan.need("parts of the light, apart");
    else
        plan.leave_out("parts of the light, apart", "no layer cloud, light or order");
    if (run.world->medium.channels == 1) plan.leave_out("albedo per colour channel", "grey media");
    if (is_white(run.world->medium)) plan.leave_out("absorption", "albedo 1");
    if (!run.lighting.opaque()) plan.leave_out("depth test", "nothing solid: no ground");
    if (!scene.wants_depth()) plan.leave_out("depth of the medium", "no depth layer");
    if (!output.layer_optical_depth) plan.leave_out("optical depth", "no optical_depth layer");
    if (!output.layer_error) plan.leave_out("standard error per pixel", "no error layer");
    if (run.settings.centre) plan.leave_out("rays spread over pixels", "pixel = \"centre\"");
    if (!path_filters(run.filter))
        plan.leave_out("filter of the picture", "filter.kind = \"none\"");
    if (run.budget.state.empty()) plan.leave_out("state of the tracing", "no --state");
}

void note_plan(PathRun& run) {
    const Scene& scene = *run.scene;
    Plan& plan = run.plan;
    plan = Plan{};
    plan.bias = {"path", "none", "docs/path.md"};
    if (path_filters(run.filter))
        plan.bias = {"path, filtered",
                     path_regresses(run.filter)
                         ? "small, where light follows nothing that is known without noise"
                         : "what a network of others takes for noise; other bits elsewhere",
                     "docs/filter.md"};
    if (run.settings.max_depth > 0)
        plan.bias.size = "light scattered more than " + std::to_string(run.settings.max_depth) +
                         " times is missing";
    plan.need("majorants");
    if (scene.camera.flux)
        plan.leave_out("alpha", "a flat detector: 1 everywhere");
    else
        plan.need("alpha, marched through pixel centres");
    plan.need("paths");
    note_light(scene, run, plan);
    note_solids(run.world->solids, run.environment.depth, plan);
    note_parts(scene, run, plan);
    for (const std::string& what : run.world->media_plan.needed) plan.needed.push_back(what);
    for (const LeftOut& l : run.world->media_plan.left_out) plan.left_out.push_back(l);
    for (Stage stage : kUnused) plan.skip(stage);
}

std::uint64_t pixels_of(const Scene& scene) {
    return std::uint64_t(scene.camera.resolution[0]) * std::uint64_t(scene.camera.resolution[1]);
}

void weigh_memory(const Context& context, PathRun& run) {
    const Scene& scene = *run.scene;
    const OutputSettings& output = scene.output;
    const Grid& grid = run.world->medium.grid;
    const PathInput in = path_input(context, run);
    const std::uint64_t pixels = pixels_of(scene);
    const bool again = context.frames > 1;
    const Stage traced = again ? Stage::kWrite : Stage::kPaths;
    const SkyMapBytes sky = sky_map_bytes(run.environment.sky_map);
    MemoryTable t;
    add_density_rows(grid, run.world->source, std::uint64_t(run.world->medium.count),
                     phase_bytes(run.world->medium), std::uint64_t(context.threads), sky, t);
    add_majorant_rows(
        grid, run.outlined_only ? most_tracking_blocks(grid, true) : run.majorants.tracking.size(),
        std::uint64_t(context.threads), traced, t);

    // All rows of the map, of which a ground leaves the upper ones.
    const std::uint64_t columns = std::uint64_t(run.environment.sky_map.size[0]),
                        rows = std::uint64_t(run.environment.sky_map.size[1]);
    add(t, arrays::path_sky_weight(rows, columns), arrays::path_sky_columns(rows, columns),
        arrays::path_sky_rows(rows));
    const auto sums = arrays::film_sums(in), squares = arrays::film_squares(in);
    add(t, sums, squares);
    const int finest = voxel_count(grid) <= kMostSingleVoxels ? 1 : 2;
    add(t, arrays::path_blocks(grid, run.outlined_only ? finest : run.majorants.block));
    add(t, arrays::path_samples(in));
    if (!run.budget.state.empty())
        t.add("state file", Stage::kPaths, Stage::kPaths,
              path_state_bytes(sums.bytes() + squares.bytes()));
    const std::uint64_t shown = plane_count(0, run.lighting.opaque(), scene.wants_depth()) +
                                (output.layer_optical_depth ? 1u : 0u);
    add(t, arrays::picture_planes(shown, pixels, Stage::kPaths));
    const std::uint64_t light = 3u + (output.layer_cloud || output.layer_order ? 3u : 0u) +
                                (output.layer_light ? 3u : 0u) + (output.layer_order ? 3u : 0u) +
                                (output.layer_error ? 3u : 0u);
    add(t, arrays::film_means(light, pixels));
    if (path_filters(run.filter) && !path_regresses(run.filter))
        add(t, arrays::oidn_pixels(pixels));
    if (path_regresses(run.filter)) {
        add(t, arrays::guide_nodes(run.world->medium, run.world->solids.meshes),
            arrays::guide_planes(pixels));
        if (!output.layer_optical_depth) add(t, arrays::picture_planes(1, pixels, Stage::kPaths));
        add(t, arrays::film_means(9, pixels), arrays::filter_features(pixels));
        const auto& size = scene.camera.resolution;
        add(t, arrays::filter_sums(size[0], size[1]));
        if (scene.output.layer_error)
            add(t, arrays::film_means(6, pixels), arrays::error_tiles(size[0], size[1]));
    }
    add_image_rows(std::uint64_t(scene.camera.resolution[0]),
                   std::uint64_t(scene.camera.resolution[1]),
                   4 + extra_layers(output, output.layer_error), t);
    add_solid_rows(scene, context.limits, run.world->solids, run.environment.depth, t);
    run.plan.memory = t;
    run.plan.exact = !run.outlined_only;
}

}  // namespace

Status path_measure(const Context& context, PathRun& run) {
    if (!kPlans) return Status::ok();
    note_plan(run);
    weigh_memory(context, run);
    PILEUS_TRY(
        check_limit(context.limits, LimitId::kMemory, run.plan.memory.peak(), run.scene->file));
    const PassRule rule = pass_rule(run.settings, run.budget);
    // Where an error or a time decides, no more is known than the bound: it is not work to come.
    const bool open = rule.error > 0 || rule.seconds > 0;
    const double paths =
        open ? 0 : double(pixels_of(*run.scene)) * double(rule.most) * double(context.frames);
    run.plan.work_of = "paths";
    run.plan.work = estimate_work(
        medium_work(run.world->medium, run.world->source.mean_density, double(1u << 24), paths));
    note_limits(*run.scene, run.world->medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kPixels, LimitId::kFrames, LimitId::kMemory,
                 LimitId::kScatterings, LimitId::kWork},
                run.plan);
    return check_work(run.plan.work, context.limits, run.scene->file);
}

}  // namespace pileus
