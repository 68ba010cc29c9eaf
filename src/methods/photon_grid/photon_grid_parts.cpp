// SPDX-License-Identifier: Apache-2.0
// Parts of a photon grid's light: the sun's, the singly scattered; and the optical depth. In no
// flight. in: PhotonGridState after shooting -> out: planes of the layers light, order and
// optical_depth. docs/formats.md, "Pictures out".
#include "src/methods/photon_grid/photon_grid_state.h"
#include "src/photons/lit_march.h"

namespace pileus {
namespace {

/// A picture of one part of the light, without batches.
Status show_part(const Context& context, const FrameView& view, PhotonGridState& state,
                 const GridLightInput& in, Planes& part) {
    PILEUS_TRY(
        allocate_planes(in.camera.width, in.camera.height, 3, in.lighting->opaque(), false, part));
    PILEUS_TRY(fill_lit_background(context, view, state, in, 0, part));
    return display_grid(context, view, state, in, part);
}

Status show_sun(const Context& context, const FrameView& view, PhotonGridState& state,
                GridLightInput in, Planes& planes) {
    const Lighting light = sun_alone(*in.lighting);
    in.lighting = &light;
    in.batches = 0;
    Planes part;
    PILEUS_TRY(show_part(context, view, state, in, part));
    const std::size_t pixels = part.transmittance.size();
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        part.colour[i] += part.transmittance[i % pixels] * part.background[i];
    planes.sun.swap(part.colour);
    return Status::ok();
}

/// Light that the media scattered once, straight from the sun and the lamps.
Status show_single(const Context& context, const FrameView& view, PhotonGridState& state,
                   GridLightInput in, Planes& planes) {
    if (!in.lighting->sunlit && in.lighting->lamps.empty())
        return allocate(arrays::picture_planes(3, planes.transmittance.size()), planes.single);
    Lighting light = sun_alone(*in.lighting);
    light.lamps = in.lighting->lamps;
    in.lighting = &light;
    in.batches = 0;
    in.first_order_alone = true;
    Planes part;
    PILEUS_TRY(show_part(context, view, state, in, part));
    planes.single.swap(part.colour);
    return Status::ok();
}

}  // namespace

Status add_grid_layers(const Context& context, const FrameView& view, PhotonGridState& state,
                       const GridLightInput& in, Planes& planes) {
    const OutputSettings& output = view.scene.output;
    PILEUS_TRY(add_ground_noise(context, view, state, in, planes));
    PILEUS_TRY(show_whole_rays(context, view, state, in, planes));
    if (output.layer_light) PILEUS_TRY(show_sun(context, view, state, in, planes));
    return output.layer_order ? show_single(context, view, state, in, planes) : Status::ok();
}

}  // namespace pileus
