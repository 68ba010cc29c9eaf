// SPDX-License-Identifier: Apache-2.0
// The picture of a lit photon grid: light of the cells, march, parts, layers.
// in: PhotonGridState after shooting, a camera -> out: Planes.
// docs/photon-grid.md; docs/formats.md, "Pictures out".
#include "src/methods/photon_grid/photon_grid_state.h"
#include "src/photons/lit_march.h"

namespace pileus {

NodeGrid cell_nodes(const FrameView& view, const PhotonGridState& state) {
    NodeGrid nodes{};
    for (int a = 0; a < 3; ++a) {
        nodes.size[a] = state.cells.size[a];
        nodes.per_metre[a] = float(state.cells.size[a] / view.world.medium.extent_m[a]);
    }
    return nodes;
}

namespace {

/// What cells around the camera scatter in all directions, for the picture and each batch; nothing
/// where the camera is too far away.
Status light_near(const Context& context, const FrameView& view, PhotonGridState& state,
                  const GridLightInput& in, MarchParams& k, NodeLight& light) {
    if (!shows_near(view, state)) return Status::ok();
    k.near = near_nodes(k.source, in.camera.origin);
    if (k.near.size[0] == 0) return Status::ok();
    const StageClock clock(context, "reconstruct");
    CellHarmonics sets;
    for (int part = 0; part <= in.batches; ++part)
        PILEUS_TRY(
            light_cell_harmonics(in, {part - 1, part, 1 + in.batches, stored_harmonics(in.deposit)},
                                 k.near, sets, state.picture.near_light));
    set_harmonic_sets(in, sets.sets, sets.colour, k);
    light.near = state.picture.near_light.data();
    return Status::ok();
}

/// Each cell's light towards the camera.
Status show_towards(const Context& context, const FrameView& view, PhotonGridState& state,
                    const GridLightInput& in, Planes& planes) {
    const NearNodesOfPicture near(state);
    Buffer<float> light;
    {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(light_cells(in, light));
    }
    // The picture's own digest, not those of its parts.
    if (in.lighting == &state.lights.lighting) note_colours(context, light.span(), state);
    MarchParams k = lit_march_params(view, state, in, cell_nodes(view, state));
    k.channels = 3 * (1 + in.batches);
    NodeLight lit{light.data()};
    PILEUS_TRY(light_near(context, view, state, in, k, lit));
    if (in.lighting == &state.lights.lighting)
        return march_thinned(context, view, lit, k, state, planes);
    return march_lit(context, view, state, lit, k, planes.colour.data(), planes);
}

/// Each cell's light in all directions: one march for the picture and one for each batch.
Status show_all_ways(const Context& context, const FrameView& view, PhotonGridState& state,
                     const GridLightInput& in, Planes& planes) {
    MarchParams k = lit_march_params(view, state, in, cell_nodes(view, state));
    CellHarmonics sets;
    Buffer<float> light;
    const NearNodes all{{0, 0, 0}, {k.source.size[0], k.source.size[1], k.source.size[2]}, 0, 0};
    for (int batch = -1; batch < in.batches; ++batch) {
        {
            const StageClock clock(context, "reconstruct");
            PILEUS_TRY(light_cell_harmonics(in, {batch, 0, 1, stored_harmonics(in.deposit)}, all,
                                            sets, light));
        }
        if (batch < 0 && in.lighting == &state.lights.lighting)
            note_colours(context, light.span(), state);
        set_harmonic_sets(in, sets.sets, sets.colour, k);
        float* target =
            planes.colour.data() + 3 * std::size_t(batch + 1) * planes.transmittance.size();
        PILEUS_TRY(
            batch < 0 && in.lighting == &state.lights.lighting
                ? march_thinned(context, view, NodeLight{light.data()}, k, state, planes)
                : march_lit(context, view, state, NodeLight{light.data()}, k, target, planes));
    }
    return Status::ok();
}

/// Without photons' light there is one dark node, so that the sun's first order is alone.
Status show_first_order(const Context& context, const FrameView& view, PhotonGridState& state,
                        const GridLightInput& in, Planes& planes) {
    const float dark[3] = {};
    const MarchParams k = lit_march_params(view, state, in, NodeGrid{{1, 1, 1}, {0, 0, 0}});
    return march_lit(context, view, state, NodeLight{dark}, k, planes.colour.data(), planes);
}

}  // namespace

Status display_grid(const Context& context, const FrameView& view, PhotonGridState& state,
                    const GridLightInput& in, Planes& planes) {
    PILEUS_TRY(make_sun_shadow(context, view, state));
    if (in.first_order_alone)
        PILEUS_TRY(show_first_order(context, view, state, in, planes));
    else
        PILEUS_TRY(shows_harmonics(view, state) ? show_all_ways(context, view, state, in, planes)
                                                : show_towards(context, view, state, in, planes));
    return add_lit_lamps(context, view, state, in, planes);
}

Status compose_photon_grid(const Context& context, const FrameView& view,
                           const TraceInput& launches, PhotonGridState& state, Planes& planes) {
    {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(sum_ring(launches, state));
    }
    const GridLightInput in = grid_light_input(context, view, state);
    {
        const StageClock clock(context, "background");
        PILEUS_TRY(allocate_planes(view.camera.width, view.camera.height, 3 * (1 + in.batches),
                                   state.lights.lighting.opaque(), view.wants_depth(), planes));
    }
    PILEUS_TRY(fill_lit_background(context, view, state, in, 0, planes));
    PILEUS_TRY(display_grid(context, view, state, in, planes));
    cut_below_zero(context, planes);
    return add_grid_layers(context, view, state, in, planes);
}

}  // namespace pileus
