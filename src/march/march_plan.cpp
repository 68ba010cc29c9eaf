// SPDX-License-Identifier: Apache-2.0
// Weighs a run of the raymarch: what it needs and leaves out, where sunlight comes from, memory.
// in: RaymarchRun, outlined or prepared -> out: its plan; kLimit where something is too much.
// docs/report.md, "Plan"; docs/raymarch.md
#include "kernels_cpu/core/profile.h"
#include "src/march/march_parts.h"
#include "src/picture/blue_noise.h"
#include "src/world/medium/sky_medium.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr Stage kUnused[] = {Stage::kSamples, Stage::kTree,  Stage::kCollectors,  Stage::kLeafGrid,
                             Stage::kPhotons, Stage::kPaths, Stage::kReconstruct, Stage::kSplat};

std::uint64_t pixels_of(const Scene& scene) {
    return std::uint64_t(scene.camera.resolution[0]) * std::uint64_t(scene.camera.resolution[1]);
}

/// Cells that a straight way through the grid crosses, about.
double cells_across(const Grid& grid) {
    return (double(grid.size[0]) + double(grid.size[1]) + double(grid.size[2])) / 3;
}

/// Metres that a camera which turns about its target is away from the medium at most.
double reach_of(const RaymarchRun& run) {
    double from_target = 0, target = 0, diagonal = 0;
    const Camera& c = run.scene->camera;
    for (std::size_t a = 0; a < 3; ++a) {
        const double arm = c.position_m[a] - c.target_m[a];
        const double off =
            c.target_m[a] - run.world->medium.low_m[a] - 0.5 * run.world->medium.extent_m[a];
        from_target += arm * arm;
        target += off * off;
        diagonal += run.world->medium.extent_m[a] * run.world->medium.extent_m[a];
    }
    return __builtin_sqrt(from_target) + __builtin_sqrt(target) + 0.5 * __builtin_sqrt(diagonal);
}

/// Marching from every sample, or from every node: what takes fewer samples of the density. About
/// 64 samples of a ray lie where light still matters; half a way leads out of the medium.
void choose_light(RaymarchRun& run) {
    const RaymarchSettings& s = run.settings;
    const Grid& grid = run.world->medium.grid;
    run.sky_nodes = run.world->direct_sky && s.light == RaymarchLightKind::kAuto && !s.light_cone &&
                    s.light_steps > kNearSteps;
    run.march_light = s.light == RaymarchLightKind::kMarch || s.light_cone;
    run.light_why = s.light_cone ? "light_path = \"cone\"" : "as the scene asks";
    if (s.light_cone || s.light != RaymarchLightKind::kAuto) return;
    if (run.world->direct_sky) {
        run.march_light = true;
        run.light_why = "the sky is evaluated in place";
        if (run.sky_nodes) run.light_why = "steps from nodes around the camera";
        return;
    }
    if (grid.constant) {
        run.march_light = true;
        run.light_why = "light between the nodes of constant cells is not linear";
        return;
    }
    const double way = 0.5 * cells_across(grid);
    const double lit = double(s.steps < 64 ? s.steps : 64) * double(pixels_of(*run.scene));
    const double marched = lit * (s.light_steps > 0 ? double(s.light_steps) : way);
    const double nodes = double(voxel_count(grid)) * way;
    run.march_light = marched < nodes;
    if (!kPlans) return;
    run.light_why = "fewer samples of the density, about " +
                    std::to_string(std::uint64_t(run.march_light ? marched : nodes)) +
                    " instead of " +
                    std::to_string(std::uint64_t(run.march_light ? nodes : marched));
}

/// What changes the picture's looks and has no physics behind it.
void note_appearance(const RaymarchSettings& s, Plan& plan) {
    constexpr const char* kTag = ": appearance, not physics";
    if (s.powder != RaymarchPowderKind::kNone) plan.need((std::string("powder") + kTag).c_str());
    if (s.ambient[0] > 0 || s.ambient[1] > 0 || s.ambient[2] > 0)
        plan.need((std::string("ambient emission") + kTag).c_str());
    if (s.peak_phase) plan.need((std::string("phase functions over their peak") + kTag).c_str());
}

bool has_sky(const Lighting& light) {
    return light.map.columns > 0 || light.sky[0] > 0 || light.sky[1] > 0 || light.sky[2] > 0;
}

/// What method optical-depth is made of.
void note_simple(const RaymarchRun& run, Plan& plan) {
    const OpticalDepthSettings& s = *run.simple;
    constexpr const char* kTag = ": appearance, not physics";
    if (run.lighting.sunlit)
        plan.need((std::string("sunlight by optical depth on nodes, doubled") + kTag).c_str());
    else
        plan.leave_out("sunlight",
                       run.scene->sun.present ? "below the ground's horizon, or dark" : "no sun");
    if (!run.lighting.sunlit)
        plan.leave_out("powder", "no sunlight");
    else if (s.powder_strength > 0)
        plan.need((std::string("powder") + kTag).c_str());
    else
        plan.leave_out("powder", "powder_strength = 0");
    if (s.ambient[0] > 0 || s.ambient[1] > 0 || s.ambient[2] > 0)
        plan.need((std::string("ambient light") + kTag).c_str());
    else
        plan.leave_out("ambient light", "optical_depth.ambient = 0");
    if (s.g >= -1) plan.need((std::string("one mean cosine for all media") + kTag).c_str());
    if (caps_extinction(run))
        plan.need("a bound on the extinction");
    else
        plan.leave_out("a bound on the extinction", "no extinction exceeds it, or it is 0");
    if (!has_sun_grid(run))
        plan.leave_out("a grid of its own for the sun's optical depth", "it is on the medium's");
}

void note_light(const Scene& scene, const RaymarchRun& run, Plan& plan) {
    const RaymarchSettings& s = run.settings;
    const bool moves = moves_sun(scene);
    const bool sun = run.lighting.sunlit || (moves && scene.sun.present);
    if (!sun)
        plan.leave_out("sunlight",
                       scene.sun.present ? "below the ground's horizon, or dark" : "no sun");
    else if (run.march_light)
        plan.need(("sunlight by a march from each sample: " + run.light_why).c_str());
    else
        plan.need(("sunlight from nodes: " + run.light_why).c_str());
    if (sun && s.forward)
        plan.need("forward scattering: approximation");
    else
        plan.leave_out("forward scattering", sun ? "scattering = \"single\"" : "no sunlight");
    if (s.many)
        plan.need("light scattered more than once as octaves of the first: approximation");
    else
        plan.leave_out("light scattered more than once", "scattering is not \"octaves\"");
    if (!has_sky(run.lighting) && !run.lighting.ground)
        plan.leave_out("skylight in the medium", "no sky, no ground");
    else if (s.sky_ambient)
        plan.need("skylight from 24 directions on coarse nodes: approximation");
    else
        plan.leave_out("skylight in the medium", "sky_light = \"none\"");
}

void note_plan(RaymarchRun& run) {
    const Scene& scene = *run.scene;
    Plan& plan = run.plan;
    plan = Plan{};
    if (run.simple != nullptr)
        plan.bias = {"optical-depth", "a look: light scattered more than once is only hinted at",
                     "docs/optical-depth.md"};
    else
        plan.bias = {"raymarch", "light scattered more than once is missing or approximate",
                     "docs/raymarch.md"};
    if (run.settings.steps > 0) {
        plan.need(run.world->direct_sky ? "the sky's noises, evaluated in place" : "majorants");
        plan.need("marched rays");
        if (run.simple != nullptr) {
            note_simple(run, plan);
        } else {
            note_light(scene, run, plan);
            note_appearance(run.settings, plan);
        }
    } else {
        plan.leave_out("marched rays", "steps = 0: the medium is not seen");
    }
    const std::size_t lamps = run.lighting.lamps.size();
    if (lamps == 0)
        plan.leave_out("lights", scene.lights.empty() ? "no [[light]]" : "dark or underground");
    else
        plan.need((std::to_string(lamps) + " lights of [[light]], " +
                   (run.settings.many ? "octaves too" : "scattered once"))
                      .c_str());
    note_emission(run.world->medium, plan);
    if (run.lighting.sunlit && scene.sun.angular_radius_deg > 0)
        plan.leave_out("the sun's disc", "a point to this method: path alone knows it");
    if (run.levels > 0)
        plan.need((std::to_string(run.levels) + " coarser levels of the density").c_str());
    else
        plan.leave_out(
            "coarser levels of the density",
            run.settings.detail ? "no step or pixel is wider than a cell" : "detail = false");
    if (run.settings.jitter == RaymarchJitterKind::kNone)
        plan.leave_out("jitter of samples", "jitter = \"none\"");
    if (run.simple == nullptr) note_upsampling(scene, run.settings.thin, plan);
    if (run.world->medium.channels == 1) plan.leave_out("albedo per colour channel", "grey media");
    note_solids(run.world->solids, run.environment.depth, plan);
    if (!run.lighting.opaque()) plan.leave_out("depth test", "nothing solid: no ground");
    if (!scene.wants_depth()) plan.leave_out("depth of the medium", "no depth layer");
    if (!scene.output.layer_optical_depth)
        plan.leave_out("optical depth", "no optical_depth layer");
    for (const std::string& what : run.world->media_plan.needed) plan.needed.push_back(what);
    for (const LeftOut& l : run.world->media_plan.left_out) plan.left_out.push_back(l);
    for (Stage stage : kUnused) plan.skip(stage);
}

void weigh_memory(const Context& context, RaymarchRun& run) {
    const Scene& scene = *run.scene;
    const OutputSettings& output = scene.output;
    const Grid& grid = run.world->medium.grid;
    const std::uint64_t pixels = pixels_of(scene), kFloat = sizeof(float);
    const bool again = context.frames > 1;
    const Stage last = again ? Stage::kWrite : Stage::kDisplay;
    MemoryTable t;
    add_density_rows(grid, run.world->source, std::uint64_t(run.world->medium.count),
                     phase_bytes(run.world->medium), std::uint64_t(context.threads),
                     sky_map_bytes(run.environment.sky_map), t);
    if (run.world->direct_sky) add_sky_rows(scene.media[0].sky, last, t);
    add_majorant_rows(grid, run.outlined_only ? 1 : run.majorants.tracking.size(),
                      std::uint64_t(context.threads), last, t);
    if (!run.march_light && run.lighting.sunlit) add(t, arrays::sun_depth(sun_grid(run), last));
    if (run.sky_nodes && run.lighting.sunlit)
        add(t,
            arrays::sky_light_nodes(sky_light_levels(run.world->layer.params, sky_light_bits(run)),
                                    sky_light_bits(run), last));
    add(t, arrays::lamp_depths(lamp_numbers(run.world->medium, run.lighting)));
    if (caps_extinction(run)) add(t, arrays::capped_density(grid));
    if (has_sun_grid(run)) {
        add(t, arrays::lit_density(sun_grid(run)));
        add_majorant_rows(sun_grid(run), 0, std::uint64_t(context.threads), last, t);
    }
    for (const Grid& level : level_grids(grid, run.levels)) {
        add(t, arrays::coarse_density(level, last));
        add(t, arrays::coarse_blocks(level, last));
    }
    if (run.settings.sky_ambient) {
        const std::uint64_t nodes = node_count(sky_node_grid(run.world->medium));
        const int sets = sky_node_sets(run.lighting);
        const int sky_numbers =
            sky_seen_numbers(sky_view(run).turned, octaves_of(run.settings).count);
        add(t, arrays::sky_light(nodes, sets, last));
        if (sets > 0) add(t, arrays::sky_seen(nodes, sky_numbers));
    }
    const std::uint64_t parts = march_part_planes(run);
    if (run.settings.sky_ambient && output.layer_order) {
        const std::uint64_t nodes = node_count(sky_node_grid(run.world->medium));
        const int sets = sky_node_sets(run.lighting);
        add(t, renamed(arrays::sky_light(nodes, sets, last), "skylight scattered once",
                       Stage::kDisplay, last));
        if (sets > 0)
            add(t, renamed(arrays::sky_seen(nodes, kSkyParts), "skylight scattered once",
                           Stage::kDisplay, Stage::kWrite));
    }
    if (parts > 0)
        add(t, renamed(arrays::picture_planes(plane_count(3, run.lighting.opaque(), false), pixels),
                       "planes of a part", Stage::kDisplay, Stage::kDisplay));
    const std::uint64_t shown = parts + plane_count(3, run.lighting.opaque(), scene.wants_depth()) +
                                (output.layer_optical_depth ? 1u : 0u);
    add(t, arrays::picture_planes(shown, pixels));
    add(t, arrays::ground_shadow(most_ground_nodes(run.world->medium, run.lighting, pixels)));
    if (run.settings.jitter == RaymarchJitterKind::kBlueNoise) add(t, arrays::blue_noise(last));
    const bool half = scene.wants_depth() || run.settings.thin.temporal > 0;
    add_upsample_row(run.settings.thin, scene.camera.resolution, run.lighting.opaque(), half,
                     output.layer_optical_depth, last, t);
    add(t, arrays::raymarch_counts(std::uint64_t(scene.camera.resolution[1])));
    add_image_rows(std::uint64_t(scene.camera.resolution[0]),
                   std::uint64_t(scene.camera.resolution[1]),
                   4 + extra_layers(output, false) + parts - (output.layer_light ? 3u : 0u) -
                       (output.layer_order ? 3u : 0u),
                   t);
    add_solid_rows(scene, context.limits, run.world->solids, run.environment.depth, t);
    if (run.world->solids.meshes && run.lighting.sunlit)
        t.add("shadow of solids", Stage::kShadow, last, bytes_of(kFloat, voxel_count(grid)));
    run.plan.memory = t;
    run.plan.exact = !run.outlined_only;
}

}  // namespace

int sky_light_bits(const RaymarchRun& run) {
    return run.settings.thin.every() > 1 ? kMostSkyLightBits - 1 : kMostSkyLightBits;
}

Status march_measure(const Context& context, RaymarchRun& run) {
    choose_light(run);
    run.levels =
        raymarch_levels(run.settings, make_camera(run.scene->camera, 0, run.world->medium.low_m),
                        run.world->medium, reach_of(run));
    if (!kPlans) return Status::ok();
    note_plan(run);
    weigh_memory(context, run);
    note_limits(*run.scene, run.world->medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kPixels, LimitId::kFrames, LimitId::kMemory}, run.plan);
    return check_limit(context.limits, LimitId::kMemory, run.plan.memory.peak(), run.scene->file);
}

}  // namespace pileus
