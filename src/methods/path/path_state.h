// SPDX-License-Identifier: Apache-2.0
// What method `path` keeps between its calls.
// in: a scene -> out: a film, the planes behind its light, what paths are traced by.
// docs/path.md
#pragma once
#include "src/methods/method.h"
#include "src/methods/path/path_importance.h"
#include "src/methods/path/trace_paths.h"
#include "src/picture/filter/guides.h"
#include "src/picture/layers.h"
#include "src/world/camera/view.h"
#include "src/world/majorant/majorants.h"
#include "src/world/world.h"

namespace pileus {

/// Each view has a film of its own.
struct PathState {
    PathSettings settings;  ///< the scene's
    FilterSettings filter;
    bool live = false;          ///< a host's, which asks for no errors
    bool outlined_only = true;  ///< sizes are known, values are not
    Majorants majorants;
    CameraParams camera{};
    std::uint64_t seed = 0;  ///< of the frame
    Planes planes;
    FilterGuides guides;  ///< empty without a filter
    Film film;
    bool begun = false;  ///< the film is that of the view
    PathScratch scratch;
    bool splits = false;        ///< paths by importance
    PathImportance importance;  ///< where it splits alone
    PathTally tally{};          ///< of all films before this one
    bool interrupted = false;
};

/// What launches of paths read.
PathInput path_input(const Context& context, const FrameView& view, const PathState& state);

/// Whether the film keeps light apart by where it comes from.
bool path_parts(const OutputSettings& output);

/// An empty film, what the medium shows along the rays through pixel centres, and what paths are
/// traced by. kLimit: out of memory.
Status begin_film(const Context& context, const FrameView& view, PathState& state);
/// So many samples more for each of its pixels, fewer where the user ends it.
Status trace_film(const Context& context, const FrameView& view, std::uint64_t samples,
                  PathState& state);
/// The film as planes, filtered and seen through the air. kLimit: out of memory.
Status show_film(const Context& context, const FrameView& view, PathState& state);

/// What the sky shows of itself, [3][pixel]; left empty where it is black.
Status path_sky_behind(const Context& context, const FrameView& view, const PathState& state,
                       Buffer<float>& out);

/// What of the film's light has come straight through the media from something solid, and from the
/// sky for a filter: the air changes it in another way. Before the filter; nothing without air.
Status path_straight(const Context& context, const FrameView& view, const PathState& state,
                     Buffer<float>& straight);
/// The planes seen through the air. After the filter; nothing without air.
Status path_air(const Context& context, const FrameView& view, PathState& state,
                Buffer<float>& straight);

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

/// Takes the noise out of the planes' colour. kLimit: out of memory.
Status path_filter(const Context& context, const FrameView& view, PathState& state);
/// The same by regression, with what is left of the noise in the planes' error.
Status path_filter_with_error(const Context& context, const FrameView& view, PathState& state);
/// The filters of foreign libraries.
Status denoise_film(const Context& context, const FrameView& view, PathState& state);

/// Standard errors of one channel of the film; `out`, [pixel], and `sum` may be null.
void film_errors(int threads, const PathState& state, int channel, float* out, ErrorSum* sum);
/// Their sum over the cloud's pixels.
ErrorSum path_error(const Context& context, const PathState& state);
/// Of the film filtered by regression. Leaves the planes' colour filtered, which each picture makes
/// anew. kLimit: out of memory.
Status path_filtered_error(const Context& context, const FrameView& view, PathState& state,
                           ErrorSum& sum);

/// What all films have traced.
PathTally tally_of(const PathState& state);

}  // namespace pileus
