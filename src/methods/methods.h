// SPDX-License-Identifier: Apache-2.0
// What every method is: a recipe of functions over a run of its own, called frame by frame.
// in: a scene, budgets, frames -> out: images and what the report says of them.
// docs/architecture.md, "Methods are recipes".
#pragma once
#include <memory>
#include <string>

#include "src/io/images/image.h"
#include "src/run/context.h"
#include "src/scene/scene.h"

namespace pileus {

/// When tracing ends, instead of what the scene says; a method takes the kinds that it knows.
struct Budget {
    std::int64_t photons = -1;  ///< >= 0: so many
    std::int64_t samples = -1;  ///< >= 1: so many for each pixel
    std::int64_t steps = -1;    ///< >= 0: so many of a ray
    double error = 0;           ///< > 0: the mean relative standard error to reach
    double seconds = 0;         ///< > 0: wall time; chooses only a whole number of passes
    std::string state;          ///< file that keeps progress; empty: none
    double state_every_s = 60;  ///< between two writings of it
};

/// One picture of a run. `first` and `last` are those of the run, not of the animation.
struct FrameStep {
    int frame = 0;
    bool first = true, last = true;
};

/// What a method keeps between its functions; each derives its own.
struct MethodRun {
    MethodRun() = default;
    MethodRun(const MethodRun&) = delete;
    MethodRun& operator=(const MethodRun&) = delete;
    virtual ~MethodRun() = default;
};

/// A recipe. Functions are called from the top down, `light` to `report` once for each frame. The
/// scene and the context outlive the run.
struct Method {
    const char* name;  ///< of a view: as `--show` names it
    std::unique_ptr<MethodRun> (*make)();
    /// kBadInput: a budget that the method does not know, or a scene that it cannot render.
    Status (*check)(const Scene&, const Budget&);
    /// Sizes and the plan, reading no values.
    Status (*outline)(const Scene&, const Budget&, const Context&, MethodRun&);
    /// Instead of `outline`: all that comes before light.
    Status (*prepare)(const Scene&, const Budget&, const Context&, MethodRun&);
    void (*report_plan)(const MethodRun&, const Context&, Report&);
    /// Traces for one frame. kCheckFailed: interrupted before there is anything to show.
    Status (*light)(const FrameStep&, const Context&, MethodRun&);
    Status (*show)(const FrameStep&, const Context&, MethodRun&, Image&);
    void (*report)(const MethodRun&, Report&);
    bool shows_light = true;  ///< colours are light, which an exposure applies to
};

inline double share_of_frame(const Animation& a, int frame) {
    return a.frames > 1 ? double(frame) / (a.frames - 1) : 0.0;
}

/// Elevation of the sun in a frame, degrees.
inline double sun_at(const Scene& scene, int frame) {
    const Animation& a = scene.animation;
    if (!a.present || !a.moves_sun) return scene.sun.elevation_deg;
    const auto& range = a.sun_elevation_deg;
    return range[0] + (range[1] - range[0]) * share_of_frame(a, frame);
}

/// Angle by which the camera has turned about its target in a frame, degrees.
inline double orbit_at(const Scene& scene, int frame) {
    const Animation& a = scene.animation;
    if (!a.present || !a.moves_camera) return 0.0;
    const auto& range = a.camera_orbit_deg;
    return range[0] + (range[1] - range[0]) * share_of_frame(a, frame);
}

/// The fault of a budget of a kind that the method does not know.
inline Status unknown_budget(const char* option, const std::string& method, const char* allowed) {
    return Status::bad_input(std::string(option) + ": not for method " + method +
                             ", allowed: " + allowed);
}

}  // namespace pileus
