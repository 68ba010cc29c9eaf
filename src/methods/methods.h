// SPDX-License-Identifier: Apache-2.0
// A method as a recipe of functions over a run of its own, called frame by frame: what most of them
// are. in: a scene, budgets, frames -> out: images and what the report says of them.
// docs/architecture.md, "Methods"
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "src/io/images/image.h"
#include "src/methods/method.h"
#include "src/picture/nodes/sun_slices.h"
#include "src/scene/frames.h"

namespace pileus {

struct MethodTools;

/// One picture of a run. `first` and `last` are those of the run, not of the animation.
struct FrameStep {
    int frame = 0;
    bool first = true, last = true;
    LateRows* late = nullptr;  ///< 8-bit pixels are all that is wanted: takes what may be left
};

/// What all runs have: a session's of a method that is a class. A recipe derives its own, in which
/// it keeps what is between its functions, with a copy of its settings: work and clocks change that
/// alone.
struct MethodRun {
    const Scene* scene = nullptr;
    const FrameState* rest = nullptr;  ///< of the scene, but for keys; null: the scene itself
    const Image* sky = nullptr;        ///< in place of the sky map's file; null: that
    Budget budget;
    std::shared_ptr<const World> world;  ///< outlined before `outline`, loaded before `prepare`
    Environment environment;             ///< likewise
    Plan plan;
    Lighting lighting;
    /// The sun of a frame of the animation, in the media's coordinates.
    SunPlace sun_of(int frame) const { return sun_at(*scene, rest->sun, frame); }

    /// Moves the scene to a frame, where keys do; else null.
    std::function<void(int frame)> place_at;
    bool outlined_only = true;  ///< sizes are known, values are not
    bool sealed = false;        ///< nothing may be laid out anew: docs/flight.md
    bool alone = false;         ///< what lies behind the media is not wanted: docs/clouds.md
    double view_slack_deg = 0;  ///< by which light that is gathered for a camera may be off
    Digests digests;            ///< of what no frame changes

    MethodRun() = default;
    MethodRun(const MethodRun&) = delete;
    MethodRun& operator=(const MethodRun&) = delete;
    virtual ~MethodRun() = default;

    /// Takes, before the first picture, what pictures may need under any work, with depths or
    /// without, and what they may leave to late rows: sealed, they find it there. kLimit: out of
    /// memory.
    virtual Status reserve(LateRows&) { return Status::ok(); }

    /// From now on pictures keep no memory of their own: what is as large as a picture asks for is
    /// given back.
    virtual void seal() { sealed = true; }
};

/// How a method lives in a session, where a host moves the camera and the lights of the run's
/// scene.
struct LiveMethod {
    /// Takes them up as they are now. `anew`: the sky map is another one.
    Status (*aim)(int frame, bool anew, const Context&, MethodRun&);
    /// Traces so many whole units, fewer where the context stops it.
    Status (*advance)(std::uint64_t units, const Context&, MethodRun&, std::uint64_t& done);
    LightUnits (*units)(const MethodRun&);
    /// The picture as it is lit now; the run keeps the planes, which may be changed or taken.
    Status (*compose)(const FrameStep&, const Context&, MethodRun&, Planes*&);
    /// The work as the run was opened, every member filled in that the method has; with the next
    /// two null where it has none.
    FrameWork (*full_work)(const MethodRun&);
    /// Takes up the work of the next frames, filled in likewise, in the run's own settings.
    Status (*set_limits)(const FrameWork&, MethodRun&);
    /// The settings of a scene with such work, whose checks have the words for what is wrong with
    /// it.
    void (*put_work)(const FrameWork&, const MethodRun&, MethodTables&);
    /// What a frame of this work, all members filled in, takes at the most. kBadInput: it depends
    /// on more than the work.
    Status (*most_units)(const FrameWork&, const MethodRun&, FrameUnits&);
};

/// A recipe. Functions are called from the top down, `light` to `report` once for each frame. The
/// scene and the context outlive the run.
struct Recipe {
    const char* name;
    WorldUse world;  ///< what it asks of its world
    std::unique_ptr<MethodRun> (*make)();
    /// kBadInput: a budget that the method does not know, or a scene that it cannot render.
    Status (*check)(const Scene&, const Budget&);
    /// Sizes and the plan, reading no values.
    Status (*outline)(const Context&, MethodRun&);
    /// All that comes before light.
    Status (*prepare)(const Context&, MethodRun&);
    /// Traces for one frame. kCheckFailed: interrupted before there is anything to show.
    Status (*light)(const FrameStep&, const Context&, MethodRun&);
    Status (*show)(const FrameStep&, const Context&, MethodRun&, Image&);
    /// Adds the accidents that flights tell of, too.
    void (*count)(const MethodRun&, Counts&);
    /// All else, after `count`, for people.
    void (*report)(const MethodRun&, Report&);
    /// After `report`: in place of the budgets that were given, those by which the picture of a
    /// frame is made again, whatever ended it. Null: they do.
    void (*budget_used)(int frame, const MethodRun&, const Report&, Budget& used);
    const LiveMethod* live = nullptr;  ///< null: in no session of a host
};

/// A frame of a run, as methods see it; points into the run.
inline FrameView view_of(MethodRun& run, int frame) {
    return {*run.scene, *run.world, run.environment, run.lighting, frame, run.rest};
}

/// Its lights, as the scene is now; recipes make theirs themselves.
inline void light_frame(int frame, MethodRun& run) {
    run.lighting = light_of(*run.scene, run.sun_of(frame), *run.world, run.environment);
}

/// Fills a new run: world and environment, then by its method. `exact` false: as far as sizes tell.
/// `world`: a loaded one to share, or null for its own. Errors: those of the readers and of the
/// method.
Status open_run(const MethodRow& row, const MadeMethod& made, const Scene& scene,
                const Budget& budget, const Context& context, bool exact,
                std::shared_ptr<const World> world, MethodRun& run);
/// The plan of an open run: again where its sums have been laid out anew. Recipes make theirs
/// themselves. kLimit: over the limit of memory or of work.
Status make_plan(const MethodRow& row, const MadeMethod& made, const Context& context,
                 MethodRun& run);
/// As open_run by a recipe.
Status open_run(const Recipe& recipe, const Scene& scene, const Budget& budget,
                const Context& context, bool exact, std::shared_ptr<const World> world,
                MethodRun& run);

/// The fault of a budget of a kind that the method does not know.
inline Status unknown_budget(const char* option, const std::string& method, const char* allowed) {
    return Status::bad_input(std::string(option) + ": not for method " + method +
                             ", allowed: " + allowed);
}

/// Frame `turn`, whose sun is `sun`. Frames of an animation are what they are wherever it begins;
/// those before its first have that one's sun. A host's are counted.
SunTurn turn_of_sun(const MethodRun& run, int slices, std::int64_t turn, const SunDirection& sun);
SunTurn turn_of_sun(const FrameView& view, int slices, std::int64_t turn);

}  // namespace pileus
