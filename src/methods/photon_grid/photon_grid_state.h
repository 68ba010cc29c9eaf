// SPDX-License-Identifier: Apache-2.0
// What method `photon-grid` keeps between its calls.
// in: a scene and its medium, photons -> out: light in cells, planes of a picture.
// Elek et al. 2012, Märkl 2018 with the repairs of docs/methods.md 5; docs/photon-grid.md.
#pragma once
#include "src/methods/photon_grid/grid_light.h"
#include "src/photons/photon_state.h"

namespace pileus {

/// Photons that the sums hold where they have room, so that a budget or a session may go on.
constexpr double kMinMaxPhotons = 0x1p26;

/// Made by `prepare`, lit generation by generation, read by `render`.
struct PhotonGridState : PhotonState {
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
inline bool shows_harmonics(const FrameView& view, const PhotonGridState&) {
    return view.world.medium.grid.periodic && !view.scene.camera.orthographic;
}

/// Whether cells around the camera show each ray what they scatter along it, where it is so near.
inline bool shows_near(const FrameView& view, const PhotonGridState& state) {
    const PhotonGridSettings& s = state.settings;
    return s.closure == GridClosure::kSh && s.directions == NodeDirections::kNear &&
           !view.scene.camera.orthographic && !view.world.medium.grid.periodic;
}

/// Nodes in the middles of the cells.
NodeGrid cell_nodes(const FrameView& view, const PhotonGridState& state);

/// Generations that may be added to a sum; a ring holds its own length for ever.
std::uint64_t most_grid_generations(const PhotonGridState& state);

/// Generations of a frame that neither a time nor an error ends: the scene's, or the budget's,
/// which may be more.
std::uint64_t planned_generations(const PhotonGridState& state);

/// Lights and what a collision stores. kLimit: sums that could overflow.
Status choose_grid_light(const FrameView& view, PhotonGridState& state);
/// Why a collision stores nothing about the sun's axis; null: it does, or no phase function has
/// moments there.
const char* why_no_grid_axis(const FrameView& view, const PhotonGridState& state);

/// What a cell holds at the most.
SumBound grid_bound(const FrameView& view, const PhotonGridState& state);

/// Fills memory, work and bounds of the plan and checks them against the limits.
Status measure_photon_grid(const Context& context, const FrameView& view, PhotonGridState& state,
                           Plan& plan);

SlotSize grid_slot(const PhotonGridState& state);
/// Bytes of one thread's own sums.
std::uint64_t bytes_of_grid_thread(const PhotonGridState& state);

/// The most bytes of all arrays but threads' sums; 0 in a flight, where they alone choose the sums.
std::uint64_t photon_grid_peak(const Context& context, const FrameView& view,
                               const PhotonGridState& state);
/// The plan's memory and work, where the sums are chosen. kLimit: more than may be.
Status measure_grid_memory(const Context& context, const FrameView& view,
                           const PhotonGridState& state, std::uint64_t photons, Plan& plan);

/// What the light of the cells towards a camera is made from.
GridLightInput grid_light_input(const Context& context, const FrameView& view,
                                const PhotonGridState& state);

/// Shows light of these inputs before a background that is there.
Status display_grid(const Context& context, const FrameView& view, PhotonGridState& state,
                    const GridLightInput& in, Planes& planes);
/// What layers of files show besides the picture.
Status add_grid_layers(const Context& context, const FrameView& view, PhotonGridState& state,
                       const GridLightInput& in, Planes& planes);

/// The picture as it is lit now, as planes; `in` of launches.
Status compose_photon_grid(const Context& context, const FrameView& view, const TraceInput& in,
                           PhotonGridState& state, Planes& planes);

}  // namespace pileus
