// SPDX-License-Identifier: Apache-2.0
// What method `collectors` keeps between its calls.
// in: a scene and its medium, photons -> out: light in collectors, planes of a picture.
// Elek 2011 with the repairs of docs/methods.md 3; docs/collectors.md.
#pragma once
#include "src/methods/collectors/billboards/composite_billboards.h"
#include "src/methods/collectors/photons/reconstruct.h"
#include "src/methods/collectors/prepare/prepare.h"
#include "src/photons/photon_state.h"

namespace pileus {

/// Made by `prepare`, lit generation by generation, read by `render`.
struct CollectorsState : PhotonState {
    CollectorSettings settings;  ///< the scene's
    Prepared prepared;
    Buffer<float> source;  ///< light on nodes of the last picture
    int camera_cells = 0;  ///< > 0: the camera-directed estimate on cells of so many voxels
};

/// The display that is used: cells lit towards the camera are always marched.
inline bool is_marched(const CollectorsState& state) {
    return !state.settings.display.billboards || state.camera_cells > 0;
}

/// Whether the display keeps what each collector scatters into every direction: a perspective view
/// of a periodic medium shows each from many sides, one from within a medium those around it.
inline bool shows_harmonics(const FrameView& view, const CollectorsState& state) {
    return is_marched(state) && !view.scene.camera.orthographic &&
           (view.world.medium.grid.periodic ||
            state.settings.display.directions == NodeDirections::kAll);
}

/// Whether nodes around the camera show each ray what they scatter along it, where it is so near.
inline bool shows_near(const FrameView& view, const CollectorsState& state) {
    const CollectorSettings& c = state.settings;
    return is_marched(state) && !view.scene.camera.orthographic && !shows_harmonics(view, state) &&
           state.camera_cells == 0 && !c.closure.lobe &&
           c.display.directions == NodeDirections::kNear;
}

/// Lights and what a collision stores, for the medium as it is known now. kLimit: sums that could
/// overflow.
Status choose_collectors_light(const FrameView& view, CollectorsState& state);
/// Why a collision stores nothing about the sun's axis; null: it does, or no phase function has
/// moments there.
const char* why_no_collectors_axis(const FrameView& view, const CollectorsState& state);
/// Whether sunlight scattered once is kept apart.
bool splits_first_order(const CollectorsState& state);
/// What a collector holds at the most.
SumBound collectors_bound(const FrameView& view, const CollectorsState& state);

/// Fills memory, work and bounds of the plan, bounds or exact by what the state holds, and checks
/// them against the limits.
Status measure_collectors(const Context& context, const FrameView& view, CollectorsState& state,
                          Plan& plan);

/// What the colours of the collectors towards a camera are made from.
ReconstructInput collectors_reconstruct_input(const Context& context, const FrameView& view,
                                              const CollectorsState& state);

/// The picture of the lit collectors as planes; `launches` reads what they do.
Status compose_collectors(const Context& context, const FrameView& view, const TraceInput& launches,
                          CollectorsState& state, Planes& planes);

/// Blends the collectors as billboards of these colours, [channel][collector]; `opaque_depth` as in
/// BillboardScene, or null.
Status collectors_billboards(const Context& context, const FrameView& view,
                             const CollectorsState& state, const CameraParams& camera,
                             const CollectorColours& colours, int channels,
                             const float* opaque_depth, BillboardImage& out);

/// What is known of the method's bias in these settings.
BiasNote collectors_bias(const CollectorSettings& settings);

}  // namespace pileus
