// SPDX-License-Identifier: Apache-2.0
// What people and files are told of method `path`: what it needs and leaves out, memory, work,
// counts, digests, and how much light a film gets. in: its state, outlined, prepared or traced ->
// out: a plan, a report, a state file. docs/report.md, "Plan"; docs/path.md
#include <optional>

#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/methods/path/film_file.h"
#include "src/methods/path/film_parts.h"
#include "src/methods/path/path_blocks.h"
#include "src/methods/path/path_method.h"
#include "src/picture/filter/filter_error.h"
#include "src/picture/filter/oidn.h"
#include "src/picture/filter/regression.h"
#include "src/picture/finish_frame.h"
#include "src/picture/ordinates/ordinate_plan.h"
#include "src/scene/frames.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr Stage kNotInPaths[] = {
    Stage::kSamples,     Stage::kTree,       Stage::kCollectors, Stage::kLeafGrid, Stage::kPhotons,
    Stage::kReconstruct, Stage::kBackground, Stage::kShadow,     Stage::kSplat,    Stage::kDisplay};

bool sky_shines(const Lighting& light) {
    return light.map.columns > 0 || light.sky[0] > 0 || light.sky[1] > 0 || light.sky[2] > 0;
}

void note_sun(const FrameView& view, const PathState& state, Plan& plan) {
    const Scene& scene = view.scene;
    const bool moves = moves_sun(scene);
    if (!view.lighting.sunlit && !(moves && scene.sun.present)) {
        plan.leave_out("flights towards the sun",
                       scene.sun.present ? "below the ground's horizon, or dark" : "no sun");
        return;
    }
    plan.need("flights towards the sun");
    if (scene.sun.angular_radius_deg > 0)
        plan.need("the sun's disc");
    else
        plan.leave_out("the sun's disc", "sun.angular_radius_deg = 0");
    if (state.splits)
        plan.leave_out("branches towards the sun", "importance");
    else if (!state.settings.guide)
        plan.leave_out("branches towards the sun", "path.guide = false");
    else if (fit_guide(view.world.medium).on == 0)
        plan.leave_out("branches towards the sun", "no peaked phase function");
    else
        plan.need("branches towards the sun, weighed against scattering (MIS)");
}

void note_light(const FrameView& view, const PathState& state, Plan& plan) {
    const Lighting& light = view.lighting;
    note_sun(view, state, plan);
    if (!light.lamps.empty())
        plan.needed.push_back("flights towards " + std::to_string(light.lamps.size()) +
                              " lights of [[light]], near them from between vertices");
    else
        plan.leave_out("flights towards lights", "no [[light]]");
    if (emits(view.world.medium))
        plan.need("emission of the media at tentative collisions");
    else
        plan.leave_out("emission of the media", "no medium has any");
    if (light.map.columns > 0)
        plan.need("flights towards the sky map, weighed against scattering (MIS)");
    else
        plan.leave_out("flights towards the sky",
                       sky_shines(light) ? "constant sky: paths that leave find it" : "no sky");
    if (light.ground.present)
        plan.need("bounces off the ground");
    else
        plan.leave_out("bounces off the ground", "no ground");
}

void note_parts(const FrameView& view, const PathState& state, bool keeps_state, Plan& plan) {
    const Scene& scene = view.scene;
    const OutputSettings& output = scene.output;
    if (path_parts(output))
        plan.need("parts of the light, apart");
    else
        plan.leave_out("parts of the light, apart", "no layer cloud, light or order");
    if (view.world.medium.channels == 1) plan.leave_out("albedo per colour channel", "grey media");
    if (is_white(view.world.medium)) plan.leave_out("absorption", "albedo 1");
    note_depths(view.lighting, view.wants_depth(), plan);
    if (!output.layer_optical_depth) plan.leave_out("optical depth", "no optical_depth layer");
    if (!output.layer_error) plan.leave_out("standard error per pixel", "no error layer");
    if (state.settings.centre) plan.leave_out("rays spread over pixels", "pixel = \"centre\"");
    if (!path_filters(state.filter))
        plan.leave_out("filter of the picture", "filter.kind = \"none\"");
    if (!keeps_state) plan.leave_out("state of the tracing", "no --state");
}

void note_plan(const FrameView& view, const PathState& state, bool keeps_state, Plan& plan) {
    plan.bias = {"path", "none", "docs/path.md"};
    if (path_filters(state.filter))
        plan.bias = {"path, filtered",
                     path_regresses(state.filter)
                         ? "small, where light follows nothing that is known without noise"
                         : "what a network of others takes for noise; other bits elsewhere",
                     "docs/filter.md"};
    if (state.settings.max_depth > 0)
        plan.bias.size = "light scattered more than " + std::to_string(state.settings.max_depth) +
                         " times is missing";
    plan.need("majorants");
    if (view.scene.camera.flux)
        plan.leave_out("alpha", "a flat detector: 1 everywhere");
    else
        plan.need("alpha, marched through pixel centres");
    plan.need(state.splits ? "paths that discrete ordinates split and end" : "paths");
    if (const char* why = why_no_importance(view)) plan.leave_out("importance of paths", why);
    note_light(view, state, plan);
    note_solids(view.world.solids, view.environment.depth, plan);
    note_parts(view, state, keeps_state, plan);
    note_media(view.world.media_plan, plan);
    for (Stage stage : kNotInPaths)
        if (stage != Stage::kShadow || !state.splits) plan.skip(stage);
}

std::uint64_t film_pixels(const Scene& scene) {
    return std::uint64_t(scene.camera.resolution[0]) * std::uint64_t(scene.camera.resolution[1]);
}

void weigh_memory(const Context& context, const FrameView& view, const PathState& state,
                  bool keeps_state, bool looks, Plan& plan) {
    const Scene& scene = view.scene;
    const OutputSettings& output = scene.output;
    const Grid& grid = view.world.medium.grid;
    const PathInput in = path_input(context, view, state);
    const std::uint64_t pixels = film_pixels(scene);
    const bool again = context.frames > 1;
    const Stage traced = again ? Stage::kWrite : Stage::kPaths;
    const SkyMapBytes sky = sky_map_bytes(view.environment.sky_map, view.environment.look);
    MemoryTable t;
    add_density_rows(grid, view.world.source, std::uint64_t(view.world.medium.count),
                     phase_bytes(view.world.medium), std::uint64_t(context.threads), sky, t);
    add_majorant_rows(
        grid,
        state.outlined_only ? most_tracking_blocks(grid, true) : state.majorants.tracking.size(),
        std::uint64_t(context.threads), traced, t);

    // All rows of the map, of which a ground leaves the upper ones.
    const std::uint64_t columns = std::uint64_t(view.environment.sky_map.size[0]),
                        rows = std::uint64_t(view.environment.sky_map.size[1]);
    add(t, arrays::path_sky_weight(rows, columns), arrays::path_sky_columns(rows, columns),
        arrays::path_sky_rows(rows));
    const auto sums = arrays::film_sums(in), squares = arrays::film_squares(in);
    add(t, sums, squares);
    const int finest = voxel_count(grid) <= kMaxSingleVoxels ? 1 : 2;
    add(t, arrays::path_blocks(grid, state.outlined_only ? finest : state.majorants.block));
    add(t, arrays::path_samples(in));
    if (state.splits || (state.live && may_have_importance(view))) add_importance_rows(view, t);
    if (keeps_state)
        t.add("state file", Stage::kPaths, Stage::kPaths,
              path_state_bytes(sums.bytes() + squares.bytes()));
    const std::uint64_t shown = plane_count(0, view.lighting.opaque(), view.wants_depth()) +
                                (output.layer_optical_depth ? 1u : 0u);
    add(t, arrays::picture_planes(shown, pixels, Stage::kPaths));
    const std::uint64_t light = 3u + (output.layer_cloud || output.layer_order ? 3u : 0u) +
                                (output.layer_light ? 3u : 0u) + (output.layer_order ? 3u : 0u) +
                                (output.layer_error ? 3u : 0u);
    add(t, arrays::film_means(light, pixels));
    if (path_filters(state.filter) && !path_regresses(state.filter))
        add(t, arrays::oidn_pixels(pixels));
    if (path_regresses(state.filter)) {
        add(t, arrays::guide_nodes(view.world.medium, view.world.solids.meshes),
            arrays::guide_planes(pixels));
        if (const std::size_t lamps = view.lighting.lamps.size())
            add(t, arrays::guide_lamps(view.world.medium, lamps),
                arrays::picture_planes(4, pixels, Stage::kPaths));
        if (!output.layer_optical_depth) add(t, arrays::picture_planes(1, pixels, Stage::kPaths));
        add(t, arrays::film_means(9, pixels), arrays::filter_features(pixels));
        const auto& size = scene.camera.resolution;
        add(t, arrays::filter_sums(size[0], size[1]));
        if (scene.output.layer_error)
            add(t, arrays::film_means(6, pixels), arrays::error_tiles(size[0], size[1]),
                arrays::filter_kept(size[0], size[1]));
        if (looks)
            t.add("filter at looks", Stage::kPaths, Stage::kPaths,
                  arrays::film_means(27, pixels).bytes() + arrays::filter_features(pixels).bytes() +
                      arrays::filter_sums(size[0], size[1]).bytes() +
                      arrays::error_tiles(size[0], size[1]).bytes() +
                      arrays::filter_kept(size[0], size[1]).bytes());
    }
    add_image_rows(std::uint64_t(scene.camera.resolution[0]),
                   std::uint64_t(scene.camera.resolution[1]),
                   4 + extra_layers(output, view.depths, output.layer_error), t);
    add_solid_rows(scene, context.limits, view.world.solids, view.environment.depth, t);
    plan.memory = t;
    plan.exact = !state.outlined_only;
}

/// `budget` wins over the scene; where an error or a time decides, max_samples_per_pixel bounds.
LightGoal goal_of(const PathSettings& settings, const Budget& budget) {
    LightGoal goal;
    goal.first = "the first sample of every pixel";
    goal.seconds = budget.seconds;
    goal.early = 0.5;
    goal.error = budget.error > 0 ? budget.error : settings.target_error;
    if (budget.samples >= 0) {
        goal.most = std::uint64_t(budget.samples);
        goal.error = budget.error;  // so many samples, whatever the scene's error
        return goal;
    }
    const bool open = goal.error > 0 || goal.seconds > 0;
    goal.most = std::uint64_t(open ? settings.max_samples_per_pixel : settings.samples_per_pixel);
    return goal;
}

void estimate_paths(const Context& context, const FrameView& view, const LightGoal& goal,
                    Plan& plan) {
    const Medium& medium = view.world.medium;
    // Where an error or a time decides, no more is known than the bound: it is not work to come.
    const bool open = goal.error > 0 || goal.seconds > 0;
    const double paths =
        open ? 0 : double(film_pixels(view.scene)) * double(goal.most) * double(context.frames);
    plan.work_of = "paths";
    plan.work =
        estimate_work(medium_work(medium, view.world.source.mean_density, double(1u << 24), paths));
    note_limits(view.scene, medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kPixels, LimitId::kFrames, LimitId::kMemory,
                 LimitId::kScatterings, LimitId::kWork},
                plan);
}

std::string digest_film(const Film& film) {
    Digest d;
    for (const Buffer<double>* sums : {&film.sum, &film.square}) d.doubles(sums->span());
    return d.hex();
}

class PathReport final : public MethodReport {
public:
    PathReport(PathMethod& of, const Budget& budget) : of_(of), budget_(budget) {}

    void explain(const Context& context, const FrameView& view, Plan& plan) const override {
        const bool keeps_state = !budget_.state.empty();
        note_plan(view, of_.state(), keeps_state, plan);
        weigh_memory(context, view, of_.state(), keeps_state, goal(view).error > 0, plan);
        estimate_paths(context, view, goal(view), plan);
    }

    void digest(const FrameView& view, Digests& digests) const override {
        Digest majorants;
        majorants.floats(of_.state().majorants.tracking.span());
        digests = {{"density", density_digest(view.world)}, {"majorants", majorants.hex()}};
    }

    LightGoal goal(const FrameView&) const override {
        return goal_of(of_.state().settings, budget_);
    }

    /// Of a picture filtered by regression what its filter leaves, else that of the samples.
    Status error(const Context& context, const FrameView& view, double& mean_relative) override {
        ErrorSum sum;
        if (path_regresses(of_.state().filter))
            PILEUS_TRY(of_.filtered_error(context, view, sum));
        else
            sum = path_error(context, of_.state());
        mean_relative = sum.mean_relative();
        return Status::ok();
    }

    Status save(const std::string& path) const override {
        return write_path_state(path, state_digest_, of_.state().film);
    }

    Status resume(const Context& context, const FrameView& view, const std::string& path) override {
        PILEUS_TRY(can_write_file(path));
        PILEUS_TRY(of_.begin(context, view));
        state_digest_ = path_state_digest(of_.input(context, view), context.report->version);
        PILEUS_TRY(read_path_state(path, state_digest_, of_.film()));
        const Film& film = of_.state().film;
        add_tally(film.tally, earlier_);
        const std::uint64_t samples = film.samples + film.ahead_samples, most = goal(view).most;
        if (samples <= most) return Status::ok();
        return Status::bad_input(path + ": state: holds " + std::to_string(samples) +
                                 " samples per pixel, " + std::to_string(most) +
                                 " asked for, allowed: as many or more, or another file");
    }

    Status bring_together(WorkShare& share) override { return share_film(share, of_.film()); }
    Status take_light(PartLight& light) override { return take_film(of_.state().film, light); }
    Status add_light(const PartLight& light, const std::vector<int>& lines, bool counts) override {
        return add_film(light, lines, counts, of_.film());
    }

    void digest_picture(const Context& context, Digests& digests) override {
        if (context.digests) digests.emplace_back("film", digest_film(of_.state().film));
        shown_ = path_error(context, of_.state());
    }

    FinishedParts finished() const override {
        FinishedParts parts;
        parts.film = of_.state().film.parts;
        return parts;
    }

    void report(Report& report) const override {
        const PathState& state = of_.state();
        const PathTally all = tally_of(state);
        report_error(report);
        report.interrupted = state.interrupted;
        report.paths.samples_per_pixel = state.film.samples;
        report.paths.ahead_pixels = state.film.ahead;
        report.paths.ahead_samples = state.film.ahead > 0 ? state.film.ahead_samples : 0;
        report.paths.traced = std::uint64_t(all.paths);
        report.events.scatterings = std::uint64_t(all.scatterings);
        report.events.tentative = std::uint64_t(all.tentative);
        report.events.crossings = std::uint64_t(all.crossings);
        report.paths.shadow_rays = std::uint64_t(all.shadow_rays);
        report.paths.earlier = std::uint64_t(earlier_.paths);
        report.paths.earlier_scatterings = std::uint64_t(earlier_.scatterings);
        report.executed.emplace_back("ground_bounces", std::uint64_t(all.bounces));
        report.executed.emplace_back("shadow_rays", std::uint64_t(all.shadow_rays));
        if (!state.splits) return;
        report.executed.emplace_back("splits", std::uint64_t(all.splits));
        report.executed.emplace_back("unsplit", std::uint64_t(all.unsplit));
        if (state.importance.made) tell_ordinates(state.importance.nodes, report);
    }

    /// Whole passes; a film that ran on within one has more of some pixels.
    void budget_used(int, const Report& report, Budget& used) const override {
        used.samples = std::int64_t(report.paths.samples_per_pixel);
    }

    void put_work(const FrameWork&, MethodTables&) const override {}

private:
    /// The report tells the error of samples also where no layer shows it.
    void report_error(Report& report) const {
        const PathState& state = of_.state();
        const std::string samples =
            std::to_string(state.film.samples) +
            (state.film.samples == 1 ? " sample a pixel" : " samples a pixel");
        if (path_regresses(state.filter)) {
            report.errors.of =
                report.errors.known
                    ? "noise that the filter leaves of " + samples + ", without its bias"
                    : "none: of a filtered picture the layer \"error\" tells it";
            return;
        }
        if (path_filters(state.filter))
            report.errors.of = "none: filter.kind \"oidn\" tells none";
        else if (state.film.samples < 2)
            report.errors.of = "none: one sample a pixel has no scatter";
        else if (!shown_ || shown_->count == 0)
            report.errors.of = "none: no pixel with A > 0.02";
        else {
            report.errors.of = "noise of " + samples;
            if (report.errors.known) return;
            report.errors.known = true;
            report.errors.mean_relative = shown_->mean_relative();
            report.errors.rmse_estimate = shown_->rms();
        }
    }

    PathMethod& of_;
    const Budget budget_;
    std::uint64_t state_digest_ = 0;
    PathTally earlier_{};            ///< of what state files brought
    std::optional<ErrorSum> shown_;  ///< of a film's last picture
};

}  // namespace

std::unique_ptr<MethodReport> path_report(PathMethod& method, const Budget& budget) {
    return std::make_unique<PathReport>(method, budget);
}

}  // namespace pileus
