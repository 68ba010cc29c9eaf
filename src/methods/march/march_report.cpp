// SPDX-License-Identifier: Apache-2.0
// What people are told of marched methods: what they need, where sunlight comes from, memory,
// counts, digests.
// in: MarchState, outlined or prepared -> out: a plan, a report.
// docs/report.md, "Plan"; docs/raymarch.md
#include "src/methods/march/march_method.h"
#include "src/methods/march/march_parts.h"
#include "src/picture/blue_noise.h"
#include "src/picture/finish_frame.h"
#include "src/picture/ordinates/ordinate_plan.h"
#include "src/picture/whole_rays.h"
#include "src/world/medium/sky_medium.h"
#include "src/world/plan_parts.h"
#include "src/world/world.h"

namespace pileus {
namespace {

constexpr Stage kUnused[] = {Stage::kSamples, Stage::kTree,  Stage::kCollectors,  Stage::kLeafGrid,
                             Stage::kPhotons, Stage::kPaths, Stage::kReconstruct, Stage::kSplat};

std::uint64_t pixels_of(const Scene& scene) {
    return std::uint64_t(scene.camera.resolution[0]) * std::uint64_t(scene.camera.resolution[1]);
}

/// What changes the picture's looks and has no physics behind it.
void note_appearance(const RaymarchSettings& s, Plan& plan) {
    constexpr const char* kTag = ": appearance, not physics";
    if (s.look.powder != RaymarchPowderKind::kNone)
        plan.need((std::string("powder") + kTag).c_str());
    if (s.look.ambient[0] > 0 || s.look.ambient[1] > 0 || s.look.ambient[2] > 0)
        plan.need((std::string("ambient emission") + kTag).c_str());
    if (s.look.peak_phase)
        plan.need((std::string("phase functions over their peak") + kTag).c_str());
}

bool has_sky(const Lighting& light) {
    return light.map.columns > 0 || light.sky[0] > 0 || light.sky[1] > 0 || light.sky[2] > 0;
}

/// What method optical-depth is made of.
void note_look(const FrameView& view, const MarchState& state, Plan& plan) {
    const OpticalDepthSettings& s = *state.choice.look;
    constexpr const char* kTag = ": appearance, not physics";
    if (view.lighting.sunlit)
        plan.need((std::string("sunlight by optical depth on nodes, doubled") + kTag).c_str());
    else
        plan.leave_out("sunlight",
                       view.scene.sun.present ? "below the ground's horizon, or dark" : "no sun");
    if (!view.lighting.sunlit)
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
    if (caps_extinction(view, state))
        plan.need("a bound on the extinction");
    else
        plan.leave_out("a bound on the extinction", "no extinction exceeds it, or it is 0");
    if (!has_sun_grid(view, state))
        plan.leave_out("a grid of its own for the sun's optical depth", "it is on the medium's");
}

void note_light(const FrameView& view, const MarchChoice& choice, Plan& plan) {
    const Scene& scene = view.scene;
    const RaymarchSettings& s = choice.settings;
    const bool moves = moves_sun(scene);
    const bool sun = view.lighting.sunlit || (moves && scene.sun.present);
    if (!sun)
        plan.leave_out("sunlight",
                       scene.sun.present ? "below the ground's horizon, or dark" : "no sun");
    else if (choice.march_light)
        plan.need(("sunlight by a march from each sample: " + choice.light_why).c_str());
    else
        plan.need(("sunlight from nodes: " + choice.light_why).c_str());
    if (sun && s.scattering.forward)
        plan.need("forward scattering: approximation");
    else
        plan.leave_out("forward scattering", sun ? "scattering = \"single\"" : "no sunlight");
    if (s.scattering.ordinates)
        plan.need("light scattered more than once by discrete ordinates on coarse nodes");
    else if (s.scattering.many)
        plan.need("light scattered more than once as octaves of the first: approximation");
    else
        plan.leave_out("light scattered more than once", "scattering is not \"octaves\"");
    if (choice.beyond_ordinates != nullptr)
        plan.leave_out("discrete ordinates", choice.beyond_ordinates);
    if (!has_sky(view.lighting) && !view.lighting.ground.present)
        plan.leave_out("skylight in the medium", "no sky, no ground");
    else if (s.scattering.ordinates)
        plan.need("skylight by discrete ordinates on coarse nodes");
    else if (s.light.sky_ambient)
        plan.need("skylight from 24 directions on coarse nodes: approximation");
    else
        plan.leave_out("skylight in the medium", "sky_light = \"none\"");
}

void note_plan(const FrameView& view, const MarchState& state, Plan& plan) {
    const Scene& scene = view.scene;
    const RaymarchSettings& settings = state.choice.settings;
    if (state.choice.look)
        plan.bias = {"optical-depth", "a look: light scattered more than once is only hinted at",
                     "docs/optical-depth.md"};
    else if (settings.scattering.ordinates)
        plan.bias = {"raymarch", "light scattered more than once in 32 directions on coarse nodes",
                     "docs/ordinates.md"};
    else
        plan.bias = {"raymarch", "light scattered more than once is missing or approximate",
                     "docs/raymarch.md"};
    if (settings.march.steps > 0) {
        plan.need(view.world.direct_sky ? "the sky's noises, evaluated in place" : "majorants");
        plan.need("marched rays");
        if (state.choice.look) {
            note_look(view, state, plan);
        } else {
            note_light(view, state.choice, plan);
            note_appearance(settings, plan);
        }
    } else {
        plan.leave_out("marched rays", "steps = 0: the medium is not seen");
    }
    const std::size_t lamps = view.lighting.lamps.size();
    if (lamps == 0)
        plan.leave_out("lights", scene.lights.empty() ? "no [[light]]" : "dark or underground");
    else
        plan.need((std::to_string(lamps) + " lights of [[light]], " +
                   (settings.scattering.many ? "octaves too" : "scattered once"))
                      .c_str());
    note_emission(view.world.medium, false, plan);
    if (view.lighting.sunlit && scene.sun.angular_radius_deg > 0)
        plan.leave_out("the sun's disc", "a point to this method: path alone knows it");
    if (state.choice.levels > 0)
        plan.need((std::to_string(state.choice.levels) + " coarser levels of the density").c_str());
    else
        plan.leave_out(
            "coarser levels of the density",
            settings.march.detail ? "no step or pixel is wider than a cell" : "detail = false");
    if (settings.march.jitter == RaymarchJitterKind::kNone)
        plan.leave_out("jitter of samples", "jitter = \"none\"");
    if (!state.choice.look) note_upsampling(scene, settings.thin, plan);
    if (view.world.medium.channels == 1) plan.leave_out("albedo per colour channel", "grey media");
    note_solids(view.world.solids, view.environment.depth, plan);
    const bool nodes =
        settings.scattering.ordinates && !view.world.direct_sky && settings.march.steps > 0;
    note_surface_light(view.world.solids, nodes, nodes && view.lighting.has_bright_ground(), plan);
    note_depths(view.lighting, view.wants_depth(), plan);
    if (!scene.output.layer_optical_depth)
        plan.leave_out("optical depth", "no optical_depth layer");
    note_media(view.world.media_plan, plan);
    for (Stage stage : kUnused) plan.skip(stage);
}

/// Of a sky in place; those of any extinction where its values are not known yet.
SkyOrdinateSizes level_sizes(const FrameView& view, bool outlined) {
    const World& world = view.world;
    if (!outlined) return sky_ordinate_sizes(world.layer.params, max_extinction(world.medium));
    const SkySettings& settings = view.scene.media[0].sky;
    SkyParams sky{};
    sky.low_m = float(settings.base_m);
    sky.height_m = float(settings.top_m - settings.base_m);
    sky.boxed = view.scene.media[0].box.has_bounds ? 1 : 0;
    for (int a = 0; a < 3; ++a) sky.extent_m[a] = float(world.medium.extent_m[a]);
    return sky_ordinate_sizes(sky, 1e30);
}

void add_march_ordinates(const FrameView& view, const MarchState& state, MemoryTable& t) {
    const Medium& medium = view.world.medium;
    const OrdinateNodes& made = state.light.ordinates.nodes;
    const bool levels = view.world.direct_sky;
    OrdinateSizes sizes = lit_ordinate_sizes(medium, view.lighting, view.world.solids, made);
    if (levels) {
        sizes = sky_level_sizes(medium, level_sizes(view, state.media.outlined_only));
        sizes.sets =
            std::min(std::uint64_t(ordinate_sets(medium, view.lighting, false, medium.channels)),
                     kMaxSkySets);
    }
    // Hosts have a spare level.
    if (levels && state.choice.hosted && sizes.levels > 1) ++sizes.levels;
    const bool moves = state.choice.hosted || view.scene.animation.is_film();
    const CameraParams& camera = view.camera;
    if (!made.density.empty() && !moves) sizes.moments = sees_moments(medium, camera, made.grid);
    sizes.sunlit = view.lighting.sunlit;
    if (!levels) sizes.rays = sun_of_nodes(medium, state) == nullptr;
    if (!levels && state.choice.hosted) sizes.beams = kMaxOrdinateBeams;
    sizes.points = !levels && may_have_lamps(view, state.choice);
    sizes.solids = sizes.solids && !levels;
    add_ordinate_rows(sizes, t);
}

void weigh_memory(const Context& context, const FrameView& view, const MarchState& state,
                  Plan& plan) {
    const Scene& scene = view.scene;
    const Medium& medium = view.world.medium;
    const Lighting& lighting = view.lighting;
    const RaymarchSettings& settings = state.choice.settings;
    const OutputSettings& output = scene.output;
    const Grid& grid = medium.grid;
    const std::uint64_t pixels = pixels_of(scene), kFloat = sizeof(float);
    const bool again = context.frames > 1;
    const Stage last = again ? Stage::kWrite : Stage::kDisplay;
    MemoryTable t;
    add_density_rows(grid, view.world.source, std::uint64_t(medium.count), phase_bytes(medium),
                     std::uint64_t(context.threads),
                     sky_map_bytes(view.environment.sky_map, view.environment.look), t);
    if (view.world.direct_sky) add_sky_rows(scene.media[0].sky, last, t);
    add_majorant_rows(grid, state.media.outlined_only ? 1 : state.media.majorants.tracking.size(),
                      std::uint64_t(context.threads), last, t);
    if (!state.choice.march_light && lighting.sunlit)
        add(t, arrays::sun_depth(state.media.wide_sun ? node_count(wide_sun_depth_nodes(medium))
                                                      : voxel_count(sun_grid(view, state)),
                                 last));
    if (state.choice.sky_nodes && lighting.sunlit)
        add(t, arrays::sky_light_nodes(
                   sky_light_levels(view.world.layer.params, sky_light_bits(state.choice)),
                   sky_light_bits(state.choice), last));
    if (lighting.ground.paint.sea != nullptr)
        t.add("mirrored sky", Stage::kShadow, last, bytes_of(10 * kFloat, kMirrorTexels));
    add(t, arrays::lamp_depths(lamp_numbers(medium, lighting, has_lamp_spots(view, state.choice))));
    if (caps_extinction(view, state)) add(t, arrays::capped_density(grid));
    if (has_sun_grid(view, state)) {
        add(t, arrays::lit_density(sun_grid(view, state)));
        add_majorant_rows(sun_grid(view, state), 0, std::uint64_t(context.threads), last, t);
    }
    for (const Grid& level : level_grids(grid, state.choice.levels)) {
        add(t, arrays::coarse_density(level, last));
        add(t, arrays::coarse_blocks(level, last));
    }
    if (settings.scattering.ordinates) add_march_ordinates(view, state, t);
    if (settings.light.sky_ambient && !settings.scattering.ordinates) {
        const std::uint64_t nodes = node_count(sky_node_grid(medium));
        const int sets = sky_node_sets(lighting);
        const int sky_numbers =
            sky_seen_numbers(sky_view(view, state).turned, octaves_of(settings.scattering).count);
        add(t, arrays::sky_light(nodes, sets, last));
        if (sets > 0) add(t, arrays::sky_seen(nodes, sky_numbers));
    }
    const std::uint64_t parts = march_part_planes(view, state);
    if (settings.light.sky_ambient && output.layer_order) {
        const std::uint64_t nodes = node_count(sky_node_grid(medium));
        const int sets = sky_node_sets(lighting);
        add(t, renamed(arrays::sky_light(nodes, sets, last), "skylight scattered once",
                       Stage::kDisplay, last));
        if (sets > 0)
            add(t, renamed(arrays::sky_seen(nodes, kSkyParts), "skylight scattered once",
                           Stage::kDisplay, Stage::kWrite));
    }
    if (parts > 0)
        add(t, renamed(arrays::picture_planes(plane_count(3, lighting.opaque(), false), pixels),
                       "planes of a part", Stage::kDisplay, Stage::kDisplay));
    const std::uint64_t shown = parts + plane_count(3, lighting.opaque(), view.wants_depth()) +
                                (output.layer_optical_depth ? 1u : 0u);
    add(t, arrays::picture_planes(shown, pixels));
    const std::uint64_t rays = whole_ray_planes(
        output, {settings.march.stop_below, settings.thin.every() > 1}, view.wants_depth());
    if (rays > 0 && !state.choice.hosted)
        add(t, renamed(arrays::picture_planes(rays, pixels), "planes of whole rays",
                       Stage::kDisplay, Stage::kLayers));
    add(t, arrays::ground_shadow(most_ground_nodes(medium, lighting, pixels)));
    if (settings.march.jitter == RaymarchJitterKind::kBlueNoise) add(t, arrays::blue_noise(last));
    const bool half = view.wants_depth() || settings.thin.temporal > 0;
    add_upsample_row(settings.thin, scene.camera.resolution, lighting.opaque(), half,
                     output.layer_optical_depth, last, t);
    add(t, arrays::raymarch_counts(std::uint64_t(scene.camera.resolution[1])));
    add_image_rows(std::uint64_t(scene.camera.resolution[0]),
                   std::uint64_t(scene.camera.resolution[1]),
                   4 + extra_layers(output, view.depths, false) + parts -
                       (output.layer_light ? 3u : 0u) - (output.layer_order ? 3u : 0u),
                   t);
    add_solid_rows(scene, context.limits, view.world.solids, view.environment.depth, t);
    if (view.world.solids.meshes && lighting.sunlit)
        t.add("shadow of solids", Stage::kShadow, last, bytes_of(kFloat, voxel_count(grid)));
    plan.memory = t;
    plan.exact = !state.media.outlined_only;
}

class MarchReport final : public MethodReport {
public:
    explicit MarchReport(MarchMethod& of) : of_(of) {}

    void explain(const Context& context, const FrameView& view, Plan& plan) const override {
        note_plan(view, of_.state(), plan);
        weigh_memory(context, view, of_.state(), plan);
        note_limits(view.scene, view.world.medium.grid, context.limits,
                    {LimitId::kVoxels, LimitId::kPixels, LimitId::kFrames, LimitId::kMemory}, plan);
    }

    void digest(const FrameView& view, Digests& digests) const override {
        digests = {{"density", density_digest(view.world)}};
    }

    Status add_layers(const Context& context, const FrameView& view) override {
        return add_march_layers(context, view, of_.state());
    }

    FinishedParts finished() const override {
        FinishedParts parts;
        parts.colours = true;
        return parts;
    }

    void report(Report& report) const override {
        const MarchState& state = of_.state();
        const MarchPicture& picture = state.picture;
        const SkyLight& sky_light = state.light.sky.layer;
        report.executed.emplace_back("density_levels", state.media.coarse.size());
        report.executed.emplace_back("marched_pixels", picture.upsample.marched);
        report.executed.emplace_back("recalled_pixels", picture.upsample.recalled);
        report.executed.emplace_back("ray_samples", picture.tally.samples);
        report.executed.emplace_back("light_samples", picture.tally.light_samples);
        report.executed.emplace_back("sky_light_nodes", sky_light.made);
        report.executed.emplace_back("sky_light_samples", sky_light.densities);
        report.sweep = state.light.sun.difference;
        const std::vector<SkyLevel>& levels = state.light.ordinates.sky.levels;
        if (!state.choice.settings.scattering.ordinates) return;
        const OrdinateNodes& nodes = state.light.ordinates.nodes;
        if (levels.empty()) tell_ordinates(nodes, report);
        if (levels.empty())
            report.counters.emplace_back("camera_deep",
                                         is_deep(nodes, state.light.sky.camera) ? 1 : 0);
        for (const SkyLevel& level : levels) tell_ordinates(level.nodes, report);
    }

    /// The steps that a time chose.
    void budget_used(int, const Report& report, Budget& used) const override {
        const auto& look = of_.state().choice.look;
        const bool by_cells = look && look->steps == 0;
        if (!report.light_rule.empty() && !by_cells) used.steps = report.frame_work.steps;
    }

    void put_work(const FrameWork& work, MethodTables& tables) const override {
        if (of_.state().choice.look) {
            tables.optical_depth.steps = work.steps;
            return;
        }
        pileus::put_work(work, tables.raymarch.thin);
        tables.raymarch.march.steps = work.steps;
        tables.raymarch.light.refresh = work.light_refresh;
    }

private:
    MarchMethod& of_;
};

}  // namespace

std::unique_ptr<MethodReport> march_report(MarchMethod& method) {
    return std::make_unique<MarchReport>(method);
}

void explain_march_light(double marched, double nodes, MarchChoice& choice) {
    choice.light_why = "fewer samples of the density, about " +
                       std::to_string(std::uint64_t(choice.march_light ? marched : nodes)) +
                       " instead of " +
                       std::to_string(std::uint64_t(choice.march_light ? nodes : marched));
}

}  // namespace pileus
