// SPDX-License-Identifier: Apache-2.0
// The one way to make a frame: what a session knows of a method.
// in: a world, what lights it, a frame -> out: light accumulated, planes of a picture.
// docs/architecture.md, "Methods"
#pragma once
#include <memory>
#include <vector>

#include "src/plan/budget.h"
#include "src/plan/frame_work.h"
#include "src/run/context.h"
#include "src/scene/scene.h"
#include "src/world/camera/view.h"
#include "src/world/environment.h"

namespace pileus {

struct FinishedParts;
struct Image;
struct LateRows;
struct PartLight;
struct Planes;
class WorkShare;

/// What a frame is made of; all outlive the call.
struct FrameView {
    const Scene& scene;  ///< its frame is in the media's coordinates
    const World& world;
    Environment& environment;  ///< whose air is seen by one camera after the other
    const Lighting& lighting;  ///< of this frame
    int frame = 0;             ///< its number
    /// What the suns of other frames of a film are worked out from.
    const FrameState* rest = nullptr;
    CameraParams camera{};  ///< as the frame sees the media, in metres from their low corner
    bool depths = false;    ///< a layer, or a host, shows the distance to the media

    /// Whether the picture needs it: for that, or for the air before the media.
    bool wants_depth() const { return depths || scene.atmosphere.present; }
};

struct ViewChange {
    bool new_sky = false;    ///< the sky map is another one, the air's among them
    bool new_shine = false;  ///< what shines is another but for the sun's direction: same_shine
    bool new_run = false;    ///< of a film: pictures before this one count no more
    /// Both are those of a sun that has moved a little through the air: pictures before this one
    /// may still be shown in part.
    bool follows_sun = false;
};

struct RenderAsk {
    LateRows* late = nullptr;   ///< 8-bit pixels are all that is wanted: takes what may be left
    bool media_only = false;    ///< what lies behind the media is not wanted: docs/clouds.md
    double view_slack_deg = 0;  ///< by which light that is gathered for a camera may be off
};

/// Light that a session has traced and may trace.
struct LightUnits {
    const char* unit = "";           ///< of what a step counts: "generation", "sample"
    const char* stage = nullptr;     ///< of the report, while it is traced; null: it has a clock
    std::uint64_t whole = 0;         ///< units that a first picture should have
    std::uint64_t unit_photons = 0;  ///< photons or paths of one
    std::uint64_t held = 0;          ///< units that the next picture shows
    std::uint32_t prepared = 1;      ///< times that the sums were laid out
    bool one_sum = false;            ///< of units that are all alike: none has fewer photons
    bool in_passes = false;          ///< units are short: several are traced at a time
    bool part = false;               ///< some of the next unit is there
    bool interrupted = false;        ///< the user ended the last `accumulate`, or within it
    /// Of a film's frame, each traced for the view of a frame of its own; 0: all for that frame.
    std::uint64_t ring = 0;
};

/// When a film's frame has its light: at the first of these. src/session/stop_rule.h
struct LightGoal {
    std::uint64_t most = 0;         ///< units
    double error = 0;               ///< > 0: mean relative standard error
    double seconds = 0;             ///< > 0: wall time
    double early = 0;               ///< so much of a unit may the time fall short
    std::uint64_t first_look = 16;  ///< units at which the error is looked at first, and then
    bool doubles = false;           ///< whenever they have doubled; else with each quarter more
    const char* first = "";         ///< in messages: what there must be before there is a picture
};

/// What may be given back: the frame has its light; no frame gets more; the picture was taken.
enum class Phase { kTraced, kEnded, kShown };

/// Functions are called from the top down, those from `set_view` to `render` for each frame. What a
/// flight has no use for, files, clocks and words for people, is in MethodReport: a table of
/// virtual functions keeps all that it names.
class Method {
public:
    Method() = default;
    Method(const Method&) = delete;
    Method& operator=(const Method&) = delete;
    virtual ~Method() = default;

    /// From sizes before `prepare`, exact after it. kBadInput: what a plan alone can see; kLimit.
    virtual Status plan(const Context& context, const FrameView& view, Plan& plan) = 0;
    /// Once, after the first `plan`, when the world is loaded: all that comes before light.
    virtual Status prepare(const Context& context, const FrameView& view) = 0;
    /// Takes, before the first picture, what pictures may need under any work, with depths or
    /// without, and what they may leave to late rows: sealed, they find it there. kLimit: out of
    /// memory.
    virtual Status reserve(const FrameView& view, LateRows& late) = 0;
    /// From now on pictures keep no memory of their own: what is as large as a picture asks for is
    /// given back.
    virtual void seal() {}
    /// Takes up camera, lights, number of the frame. What is unchanged keeps its light.
    virtual Status set_view(const Context& context, const FrameView& view,
                            const ViewChange& change) = 0;
    /// Traces so many whole units, 0: makes ready for them; `done` fewer where the context, which
    /// is asked first, stops it.
    virtual Status accumulate(const Context& context, const FrameView& view, std::uint64_t units,
                              std::uint64_t& done) = 0;
    /// Forgets what was traced; the next unit is number `first`: of films whose frames all have the
    /// same ones, 0, and of rings that begin at a frame within.
    virtual void restart(const Context& context, std::uint64_t first) {
        (void)context, (void)first;
    }
    /// The picture as it is lit now, without the air before it but where the row says so. `planes`
    /// stay the method's until its next call, and may be changed or taken.
    virtual Status render(const Context& context, const FrameView& view, const RenderAsk& ask,
                          Planes*& planes) = 0;

    /// At any time, before the first `set_view`, too.
    virtual LightUnits progress() const { return {}; }
    /// The work as the method was made, every member filled in that it has.
    virtual FrameWork full_work() const { return {}; }
    /// Takes up the work of the next frames, filled in likewise.
    virtual Status set_limits(const FrameWork& work) = 0;
    /// What a frame of this work, all members filled in, takes at the most. kBadInput: it depends
    /// on more than the work.
    virtual Status worst_case(const FrameView& view, const FrameWork& work,
                              FrameUnits& units) const = 0;
    /// Adds the accidents that flights tell of, too. Names are literals.
    virtual void count(Counts& counts) const = 0;
    /// Why a host may not move the camera; null: it may.
    virtual const char* fixed_view() const { return nullptr; }
    /// Whether the next picture reads the last one's planes, which are left alone then.
    virtual bool keeps_planes() const { return false; }
    /// Films alone call it.
    virtual void release(Phase) {}
};

/// What people and files are told of a method: an object beside it.
class MethodReport {
public:
    MethodReport() = default;
    MethodReport(const MethodReport&) = delete;
    MethodReport& operator=(const MethodReport&) = delete;
    virtual ~MethodReport() = default;

    /// Needed, left out, bias, memory by stage, limits; after `Method::plan`. Whoever asks then
    /// checks memory.
    virtual void explain(const Context& context, const FrameView& view, Plan& plan) const = 0;
    /// Of what no frame changes, after `Method::prepare`.
    virtual void digest(const FrameView& view, Digests& digests) const = 0;
    /// How much light a frame of a film gets.
    virtual LightGoal goal(const FrameView&) const { return {}; }
    /// Mean relative standard error of the light that is held; may make a picture of it.
    virtual Status error(const Context&, const FrameView&, double& mean_relative) {
        mean_relative = 0;
        return Status::ok();
    }
    /// The light of a frame as a file, and back before its first `accumulate`; a file that is not
    /// there yet is none. kBadInput: another scene's, damaged; kIo.
    virtual Status save(const std::string& path) const {
        (void)path;
        return Status::ok();
    }
    virtual Status resume(const Context&, const FrameView&, const std::string& path) {
        (void)path;
        return Status::ok();
    }
    /// What several processes have traced becomes whole at the first of them; the others go on with
    /// their share.
    virtual Status bring_together(WorkShare& share) {
        (void)share;
        return Status::ok();
    }
    /// The light of a part of a frame, and that of one into the frame's, after an `accumulate` of
    /// 0: `lines` are the rows of the picture that are the part's, `counts`: with it the frame has
    /// all units of its work. Works of other seeds are added. kBadInput: of another work; kLimit:
    /// out of memory, or too much for the sums.
    virtual Status take_light(PartLight& light) {
        (void)light;
        return Status::ok();
    }
    virtual Status add_light(const PartLight& light, const std::vector<int>& lines, bool counts) {
        (void)light, (void)lines, (void)counts;
        return Status::ok();
    }
    /// After `Method::render` of a film's frame: what layers of files show besides the picture,
    /// into its planes. kLimit: out of memory.
    virtual Status add_layers(const Context&, const FrameView&) { return Status::ok(); }
    /// After that, before the planes become an image: digests of what it was made from.
    virtual void digest_picture(const Context&, Digests&) {}
    /// Of a view, in place of `Method::render`: the picture itself. docs/how-it-works.md
    virtual Status draw(const Context&, const FrameView&, Image&) { return Status::ok(); }
    /// Of each picture, beside its planes.
    virtual FinishedParts finished() const = 0;
    /// All else than `Method::count` has, after it.
    virtual void report(Report& report) const = 0;
    /// After `report`: in place of the budgets that were given, those by which the picture of a
    /// frame is made again, whatever ended it.
    virtual void budget_used(int frame, const Report& report, Budget& used) const {
        (void)frame, (void)report, (void)used;
    }
    /// The settings of a scene with such work, whose checks have the words for what is wrong with
    /// it.
    virtual void put_work(const FrameWork& work, MethodTables& tables) const = 0;
};

/// What a method is made from; it takes copies of its own.
struct MethodInputs {
    const Scene& scene;
    const Budget& budget;
    bool live = false;  ///< a host's session, which asks for no errors
};

struct MadeMethod {
    std::unique_ptr<Method> method;
    std::unique_ptr<MethodReport> report;  ///< null in a flight
};

/// A name of `method.name` or of `--show`, and what is made by it.
struct MethodRow {
    const char* name = "";
    WorldUse world{};  ///< what it asks of its world
    /// kBadInput: a budget that the method does not know, or a scene that it cannot render. Null in
    /// a flight.
    Status (*check)(const Scene&, const Budget&) = nullptr;
    MadeMethod (*make)(const MethodInputs&) = nullptr;
    bool keeps_parts = false;  ///< light is traced with depths and the cloud's part, or without
    bool shows_light = true;   ///< colours are light, which an exposure applies to
    Division division = Division::kRows;
    bool shows_air = false;  ///< `render` does; else whoever asks for the picture
};

}  // namespace pileus
