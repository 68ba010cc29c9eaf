// SPDX-License-Identifier: Apache-2.0
// See session.h. Opening and drawing; session_set.cpp takes what a host sets.
#include "src/session/session.h"

#include "platform/clock.h"
#include "platform/fp_mode.h"
#include "src/base/digest.h"
#include "src/io/volumes/weather_file.h"
#include "src/methods/registry.h"
#include "src/scene/read_scene.h"
#include "src/session/run_context.h"
#include "src/world/atmosphere/atmosphere.h"
#include "src/world/camera/view.h"
#include "src/world/place_scene.h"

namespace pileus {
namespace {

/// Pictures that a live session plans for: more than one, so that nothing is freed between them.
constexpr int kLiveFrames = 2;

/// What a host cannot ask for is left out; what it may ask for is planned.
void make_live(bool parts, bool layers, Scene& scene) {
    scene.animation = Animation{};
    scene.animation.present = true;
    scene.animation.frames = kLiveFrames;
    if (!layers) static_cast<FileLayers&>(scene.output) = FileLayers{};
    scene.output.layer_depth = !scene.camera.flux;
    scene.output.layer_cloud = parts || (layers && scene.output.layer_cloud);
    scene.view_files.depth.clear();
    // A change is checked on a copy of the scene, and its faults name no line of a file.
    scene.text.clear();
    scene.places.clear();
    scene.overrides.clear();
}

double stage_seconds(const Report& report) {
    double sum = 0;
    for (const StageTime& stage : report.clocks.stages) sum += stage.wall_s;
    return sum;
}

}  // namespace

Status make_world(const Scene& scene, const RenderOptions& options, std::shared_ptr<World>& world) {
    const FpModeGuard guard;
    ThreadPool threads;
    const PoolGuard lent(threads);
    Report report;
    Context context;
    MethodRow row;
    PILEUS_TRY(make_context(scene, options, context, report));
    PILEUS_TRY(find_method(scene, row));
    const auto made = std::make_shared<World>();
    const std::shared_ptr<WeatherFiles> files = make_weather_files();
    HostMedia given;
    if (options.media != nullptr) given = *options.media;
    given.weather = files.get();
    PILEUS_TRY(outline_world(scene, row.world, given, context, *made));
    // Sessions weigh all they need; here it is the grid, of which each medium has its part.
    const std::uint64_t media = made->direct_sky ? 0 : std::uint64_t(scene.media.size());
    PILEUS_TRY(check_limit(context.limits, LimitId::kMemory,
                           bytes_of(media, voxel_count(made->medium.grid) * sizeof(float)),
                           scene.file));
    PILEUS_TRY(load_world(scene, given, context, *made));
    world = made;
    return Status::ok();
}

Status make_world(const Scene& scene, const RenderOptions& options,
                  std::shared_ptr<const World>& world) {
    std::shared_ptr<World> made;
    PILEUS_TRY(make_world(scene, options, made));
    world = std::move(made);
    return Status::ok();
}

Status Session::open(const Scene& scene, const RenderOptions& options, bool exact,
                     std::shared_ptr<const World> world) {
    return open_either(scene, scene, options, true, exact, std::move(world));
}

Status Session::open(const Scene& scene, const FrameState& frame, const RenderOptions& options,
                     std::shared_ptr<const World> world) {
    return open_either(scene, frame, options, true, true, std::move(world));
}

Status Session::open_film(const Scene& scene, const FrameState& frame, const RenderOptions& options,
                          bool exact, std::shared_ptr<const World> world) {
    return open_either(scene, frame, options, false, exact, std::move(world));
}

Status Session::open_either(const Scene& scene, const FrameState& frame,
                            const RenderOptions& options, bool hosted, bool exact,
                            std::shared_ptr<const World> world) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    PILEUS_TRY(refuse_clouds(scene));
    scene_ = scene;
    static_cast<FrameState&>(scene_) = frame;
    scenery_.weather = make_weather_files();
    PILEUS_TRY(place_scene(scene_, scenery_.weather.get()));
    scene_.sky.mapped = options.sky != nullptr || !scene_.view_files.sky_map.empty();
    options_ = options;
    if (hosted && scene_.crop[2] > 0)
        return at_key(scene_, "camera.crop",
                      Status::bad_input("of pictures in files alone, allowed: left out"));
    const Status found = find_method(scene_, row_);
    if (hosted) make_live(found && row_.keeps_parts, options.layers, scene_);
    host_ = scene_;
    if (hosted) keep_opened();
    PILEUS_TRY(make_context(scene_, options, context_, report_));
    if (hosted) context_.frames = kLiveFrames;
    context_.digests = !hosted && options.digests;
    PILEUS_TRY(found);
    PILEUS_TRY(check_method(hosted, world.get()));
    made_ = row_.make({scene_, options_.budget, hosted});
    if (hosted)
        scenery_.show(scene_, scene_);
    else
        scenery_.show(scene_, host_);
    scenery_.media = options.media;
    scenery_.keyed = !scene_.animation.keys.empty();
    move_to(host_.number);
    PILEUS_TRY(
        open_method(row_, made_, context_, exact, options.sky, std::move(world), scenery_, plan_));
    tell_plan(exact);
    whole_work_ = work_ = made_.method->full_work();
    report_.frame_work = work_;
    report_.clocks.peak_bytes = peak_memory_bytes();
    return Status::ok();
}

/// Where keys move the scene.
void Session::move_to(int frame) {
    if (scenery_.keyed) place_at_frame(host_, frame, scene_);
}

/// Where frames differ in what no method moves by itself.
Status Session::take_frame(int frame) {
    if (scenery_.keyed) PILEUS_TRY(check_placed_media(scenery_, host_.ground, frame));
    move_to(frame);
    if (!is_sequence(scene_.view_files.depth)) return Status::ok();
    host_.world.sequence_frame = scene_.world.sequence_frame = frame;
    return load_environment(scene_, context_, scenery_.environment);
}

Status Session::render_image(const FilmFrame& step, Image& image) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    PILEUS_TRY(take_frame(step.frame));
    PILEUS_TRY(film_frame(step, image));
    ++stats_.pictures;
    return Status::ok();
}

void Session::finish_report() {
    const StageClock clock(context_, "digests");
    made_.method->count(report_.counters);
    made_.report->report(report_);
}

/// Changes that a host made since the last time.
Status Session::aim() {
    if (!changed_.stale) return Status::ok();
    if (changed_.air_old) PILEUS_TRY(relight_air());
    place();
    // What late rows lead to may be laid out anew.
    if (late_.ready) last_.planes = nullptr;
    const Lighting before = scenery_.lighting;
    scenery_.light(host_.number);
    const bool new_shine = !same_shine(before, scenery_.lighting);
    Method& method = *made_.method;
    const std::uint32_t prepared = method.progress().prepared;
    ViewChange change;
    change.new_sky = changed_.anew || changed_.air_moved;
    change.new_shine = new_shine;
    change.follows_sun = changed_.air_moved && !changed_.anew;
    PILEUS_TRY(method.set_view(context_, view(), change));
    PILEUS_TRY(check_sealed());
    changed_.stale = changed_.anew = changed_.air_moved = false;
    stats_.prepared = method.progress().prepared;
    if (stats_.prepared != prepared) PILEUS_TRY(make_plan(made_, context_, scenery_, plan_));
    return Status::ok();
}

Status Session::trace(std::uint64_t units, std::uint64_t& done) {
    Method& method = *made_.method;
    const LightUnits light = method.progress();
    if (light.stage == nullptr) return method.accumulate(context_, view(), units, done);
    PILEUS_TRY(method.accumulate(context_, view(), 0, done));
    if (units == 0) return Status::ok();
    const StageClock clock(context_, light.stage);
    if (context_.interrupted && light.in_passes) return trace_passes(light.held, units, done);
    return method.accumulate(context_, view(), units, done);
}

Status Session::step(std::uint64_t units, std::uint64_t& done) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    done = 0;
    PILEUS_TRY(aim());
    const Status status = trace(units, done);
    stats_.units += done;
    report_.clocks.peak_bytes = peak_memory_bytes();
    return status;
}

LightUnits Session::light() const { return made_.method->progress(); }

Status Session::draw(const FrameView& view, const RenderAsk& ask, Planes*& planes) {
    PILEUS_TRY(made_.method->render(context_, view, ask, planes));
    if (row_.shows_air) return Status::ok();
    return show_air(context_, view, *planes);
}

Status Session::render(const FrameTarget& target) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    const double start = wall_seconds(), staged = stage_seconds(report_);
    if (target.has_depth && target.depth_kind == DepthKind::kBuffer && !depth_scale_.known)
        return Status::bad_input(
            "frame.depth: a depth buffer without a camera's near_m, allowed: a camera with it, or "
            "another kind");
    if (target.has_depth && scene_.camera.flux)
        return Status::bad_input(
            "frame.depth: a flat detector sees along no single ray, allowed: another projection");
    if (!target.layers.empty()) PILEUS_TRY(check_layers(target.layers));
    PILEUS_TRY(aim());
    if (fading_ != nullptr) {
        bool goes_on = false;
        PILEUS_TRY(fading_->begin(context_, scenery_, last_.planes, goes_on));
        if (!goes_on) fading_.reset();
    }
    last_.planes = nullptr;
    Planes* planes = nullptr;
    // A picture into nothing makes ready what the first one after a hand-over needs.
    const bool nothing = !target.has_colour && target.hash == nullptr && target.layers.empty();
    const bool rays = !scene_.camera.flux;  // a flat detector has no depths
    scenery_.depths =
        (rays && (target.has_depth || row_.keeps_parts || nothing || !target.layers.empty())) ||
        fading_ != nullptr;
    report_.counters.clear();
    report_.errors = {};
    // A hash, depths and layers are of whole planes.
    const bool late = target.has_colour && !target.has_depth && target.hash == nullptr &&
                      target.layers.empty() && fading_ == nullptr &&
                      is_late(target.colour, *context_.kernels);
    late_.ready = false;
    late_.params.filled = 0;
    RenderAsk ask;
    ask.late = late ? &late_ : nullptr;
    PILEUS_TRY(draw(view(), ask, planes));
    if (!target.layers.empty()) PILEUS_TRY(show_layers(view(), target.layers, *planes));
    const Planes* const fresh = planes;
    if (fading_ != nullptr)
        PILEUS_TRY(fading_->mix(context_, scenery_, made_.method->keeps_planes(), planes));
    last_.planes = planes;
    last_.camera = scene_.camera;
    const auto& size = scene_.camera.resolution;
    std::uint64_t broken = 0;
    if (target.has_colour) {
        const StageClock clock(context_, "pixels");
        PILEUS_TRY(late_.ready ? finish_picture(context_, *planes, size[0], size[1], target.colour,
                                                late_, broken)
                               : write_pixels(*planes, size[0], size[1], target.colour,
                                              context_.kernels, context_.threads, broken));
    }
    if (target.has_depth) {
        const StageClock clock(context_, "depths");
        write_depths(*fresh, make_camera(scene_.camera, 0, world().medium.low_m), target.depth_kind,
                     target.depth_halves, depth_scale_, target.depth);
    }
    last_.has_hash = target.hash != nullptr;
    if (last_.has_hash) {
        const StageClock clock(context_, "hash");
        *target.hash = last_.hash = hash_planes(*planes);
    }
    report_.counters.emplace_back("nan", broken);
    report_.frame = host_.number;
    ++stats_.pictures;
    stats_.render_s = wall_seconds() - start;
    stats_.stages_s = stage_seconds(report_) - staged;
    report_.clocks.frame_wall_s = stats_.render_s;
    report_.clocks.peak_bytes = peak_memory_bytes();
    return Status::ok();
}

Report Session::told() const {
    Report out = report_;
    out.hash = last_.has_hash ? hex_text(last_.hash) : std::string();
    made_.method->count(out.counters);
    made_.report->report(out);
    take_clocks(out.clocks);
    // Not that of this call: the text would grow between a host's two calls for it.
    out.clocks.peak_bytes = report_.clocks.peak_bytes;
    return out;
}

const Counts& Session::counters() {
    counted_ = report_.counters;
    made_.method->count(counted_);
    return counted_;
}

}  // namespace pileus
