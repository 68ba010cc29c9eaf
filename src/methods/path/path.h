// SPDX-License-Identifier: Apache-2.0
// Method `path`: an unbiased path tracer, the reference that the other methods are measured by.
// in: a scene -> out: images with their standard error, pass by pass until a budget is met.
// docs/path.md
#pragma once
#include "src/methods/methods.h"
#include "src/methods/path/trace_paths.h"
#include "src/picture/filter/guides.h"
#include "src/picture/layers.h"
#include "src/plan/plan.h"
#include "src/world/camera/view.h"
#include "src/world/majorant/majorants.h"
#include "src/world/world.h"

namespace pileus {

/// Everything one run holds. Each frame has a film of its own, made and freed with it.
struct PathRun : MethodRun {
    PathSettings settings;  ///< the scene's
    FilterSettings filter;
    Majorants majorants;
    CameraParams camera{};
    std::uint64_t seed = 0;  ///< of the frame
    Planes planes;
    FilterGuides guides;  ///< empty without a filter
    Film film;
    PathScratch scratch;
    PathTally earlier{};  ///< of what a state file brought
    PathTally tally{};    ///< of all films before this one
    bool interrupted = false;
    bool begun = false;  ///< a session's film belongs to its camera and light
};

/// The recipe.
const Recipe& path_method();
extern const MethodTools path_tools;

/// Lights, camera and noise of a frame.
void path_aim(int frame, PathRun& run);

/// What launches of this run's paths read.
PathInput path_input(const Context& context, const PathRun& run);

/// Whether the film keeps light apart by where it comes from.
bool path_parts(const OutputSettings& output);

/// Notes what runs and what is left out, and weighs memory and work, as bounds or exactly by what
/// the run holds. kLimit: more than the limits allow.
Status path_measure(const Context& context, PathRun& run);

/// Traces a frame's film until its budget is met or the user wants an end. Errors: those of the
/// state file; kCheckFailed: interrupted before the first sample of every pixel.
Status path_light(const FrameStep& step, const Context& context, MethodRun& run);

/// Its parts in a session: an empty film, samples for it, its planes.
Status path_begin(const Context& context, PathRun& run);
Status path_advance(std::uint64_t samples, const Context& context, PathRun& run);
Status path_planes(const Context& context, PathRun& run);

/// What the sky shows of itself, [3][pixel]; left empty where it is black.
Status path_sky_behind(const Context& context, const PathRun& run, Buffer<float>& out);

/// What of the film's light has come straight through the media from something solid, and from the
/// sky for a filter: the air changes it in another way. Before the filter; nothing without air.
Status path_straight(const Context& context, const PathRun& run, Buffer<float>& straight);
/// The planes seen through the air. After the filter; nothing without air.
Status path_air(const Context& context, PathRun& run, Buffer<float>& straight);

/// Whether the picture is filtered, and what that asks of a scene. kBadInput: it cannot be.
inline bool path_filters(const FilterSettings& filter) { return filter.kind != FilterKind::kNone; }
/// Whether guides are marched for it.
inline bool path_regresses(const FilterSettings& filter) {
    return filter.kind == FilterKind::kRegression;
}
/// As scenes name it.
inline const char* path_filter_name(const FilterSettings& filter) {
    return path_regresses(filter) ? "regression" : path_filters(filter) ? "oidn" : "none";
}
Status check_path_filter(const Scene& scene);

/// Takes the noise out of the planes' colour. kLimit: out of memory.
Status path_filter(const Context& context, PathRun& run);

/// The error of the film over the cloud's pixels, of numbers as the image holds them.
ErrorSum path_error(const PathRun& run);

/// The film as an image; frees it.
Status path_show(const FrameStep& step, const Context& context, MethodRun& run, Image& image);
void path_count(const MethodRun& run, Counts& counters);
void path_report(const MethodRun& run, Report& report);

}  // namespace pileus
