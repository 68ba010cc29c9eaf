// SPDX-License-Identifier: Apache-2.0
// Parts of a collectors picture's light: the sun's, the singly scattered; and the optical depth.
// in: CollectorsState after shooting -> out: planes of the layers light, order and optical_depth.
// docs/formats.md, "Pictures out".
#include "src/methods/collectors/collectors_display.h"
#include "src/photons/lit_march.h"

namespace pileus {
namespace {

/// A picture of one part of the light, without batches; `colours` as in collectors_display.
Status show_part(const Context& context, const FrameView& view, CollectorsState& state,
                 const ReconstructInput& lit, const CollectorColours& colours, Planes& part) {
    PILEUS_TRY(allocate_planes(lit.camera.width, lit.camera.height, 3, lit.lighting->opaque(),
                               false, part));
    PILEUS_TRY(fill_lit_background(context, view, state, lit, 0, part));
    return collectors_display(context, view, state, lit, colours, 3, part);
}

Status show_sun(const Context& context, const FrameView& view, CollectorsState& state,
                const ReconstructInput& whole, Planes& planes) {
    const Lighting light = sun_alone(*whole.lighting);
    ReconstructInput lit = whole;
    lit.lighting = &light;
    lit.batches = 0;
    CollectorColours colours;
    if (!shows_harmonics(view, state)) PILEUS_TRY(reconstruct(lit, colours));
    Planes part;
    PILEUS_TRY(show_part(context, view, state, lit, colours, part));
    const std::size_t pixels = part.transmittance.size();
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        part.colour[i] += part.transmittance[i % pixels] * part.background[i];
    planes.sun.swap(part.colour);
    return Status::ok();
}

/// Light that the media scattered once, straight from the sun and the lamps.
Status show_single(const Context& context, const FrameView& view, CollectorsState& state,
                   const ReconstructInput& whole, Planes& planes) {
    if (!whole.lighting->sunlit && whole.lighting->lamps.empty())
        return allocate(arrays::picture_planes(1, planes.colour.size()), planes.single);
    Lighting light = sun_alone(*whole.lighting);
    light.lamps = whole.lighting->lamps;
    ReconstructInput lit = whole;
    lit.lighting = &light;
    lit.batches = 0;
    lit.first_order_alone = true;
    CollectorColours colours;
    if (state.lights.deposit.first_order == 1) PILEUS_TRY(reconstruct(lit, colours));
    Planes part;
    PILEUS_TRY(show_part(context, view, state, lit, colours, part));
    planes.single.swap(part.colour);
    return Status::ok();
}

}  // namespace

Status collectors_parts(const Context& context, const FrameView& view, CollectorsState& state,
                        const ReconstructInput& lit, Planes& planes) {
    const OutputSettings& output = view.scene.output;
    PILEUS_TRY(show_whole_rays(context, view, state, lit, planes));
    if (output.layer_light) PILEUS_TRY(show_sun(context, view, state, lit, planes));
    if (output.layer_order) PILEUS_TRY(show_single(context, view, state, lit, planes));
    return Status::ok();
}

}  // namespace pileus
