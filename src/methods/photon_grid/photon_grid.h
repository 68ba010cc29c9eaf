// SPDX-License-Identifier: Apache-2.0
// Method `photon-grid`: photons into a regular grid of their own, shown by marching.
// in: a scene and its medium -> out: images, one per call of `show`.
// Elek et al. 2012, Märkl 2018 with the repairs of docs/methods.md 5; docs/photon-grid.md.
#pragma once
#include "src/methods/photon_grid/grid_light.h"
#include "src/photons/photon_frames.h"
#include "src/photons/photon_run.h"
#include "src/world/camera/view.h"

namespace pileus {

/// The recipe.
const Recipe& photon_grid_method();
extern const MethodTools photon_grid_tools;

/// Photons that the sums hold where they have room, so that a budget or a session may go on.
constexpr double kLeastMostPhotons = 0x1p26;

/// Everything about one run; made by `prepare`, lit generation by generation, read by `show`.
struct PhotonGridRun : PhotonRun {
    PhotonGridSettings settings;  ///< the scene's
    CellGrid cells;
    CellMajorants near;
    Buffer<float> shares;     ///< of each medium in a cell's extinction; empty for one medium
    double most_photons = 0;  ///< the sums hold; no fewer than the scene's
};

/// Cells of the grid that gathers: the scene's, or as many as suit its photons.
CellGrid photon_cells(const PhotonGridSettings& settings, std::int64_t photons,
                      const Medium& medium);

/// Whether cells are shown by harmonics: a perspective view of a periodic medium sees each from
/// many sides.
inline bool shows_harmonics(const PhotonGridRun& run) {
    return run.world->medium.grid.periodic && !run.scene->camera.orthographic;
}

/// Whether cells around the camera show each ray what they scatter along it, where it is so near.
inline bool shows_near(const PhotonGridRun& run) {
    const PhotonGridSettings& s = run.settings;
    return s.closure == GridClosure::kSh && s.directions == NodeDirections::kNear &&
           !run.scene->camera.orthographic && !run.world->medium.grid.periodic;
}

/// Nodes in the middles of the cells.
NodeGrid cell_nodes(const PhotonGridRun& run);

/// Generations that may be added to a sum; a ring holds its own length for ever.
std::uint64_t most_generations(const PhotonGridRun& run);

/// Generations of a frame that neither a time nor an error ends: the scene's, or the budget's,
/// which may be more.
std::uint64_t planned_generations(const PhotonGridRun& run);

/// Chooses lights and what a collision stores, and weighs the plan. kLimit: too much of something.
Status photon_grid_weigh(const Context& context, PhotonGridRun& run);

/// Majorants, marks, shares and empty sums.
Status photon_grid_prepare(const Context& context, PhotonGridRun& run);

/// Fills memory, work and bounds of the plan and checks them against the limits.
Status photon_grid_measure(const Context& context, PhotonGridRun& run);

/// What launches of this run's photons read.
TraceInput photon_grid_trace_input(const Context& context, const PhotonGridRun& run);

/// What the light of the cells towards a camera is made from.
GridLightInput photon_grid_light_input(const CameraParams& camera, const Context& context,
                                       const PhotonGridRun& run);

/// The picture as it is lit now, as planes.
Status photon_grid_compose(const CameraParams& camera, const Context& context, PhotonGridRun& run,
                           Planes& planes);

/// One picture with its layers.
Status photon_grid_show(double orbit_deg, const Context& context, PhotonGridRun& run, Image& image);

/// All level slices of the grid beside one another: flux of the light in each cell that has been
/// scattered, or its mean cosine to the first light's direction; channel `value` holds the numbers.
enum class GridSlices { kFlux, kAnisotropy };
Status photon_grid_show_slices(GridSlices what, double orbit_deg, const Context& context,
                               PhotonGridRun& run, Image& image);

/// Recipes of these views.
const Recipe* photon_grid_views(int& count);

/// Shoots what a frame needs. kCheckFailed: interrupted before there was anything to show.
Status photon_grid_light(const FrameStep& step, const Context& context, PhotonGridRun& run);

/// Fills in what the run has done.
void photon_grid_report(const PhotonGridRun& run, Report& report);

}  // namespace pileus
