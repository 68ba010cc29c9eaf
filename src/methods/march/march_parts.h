// SPDX-License-Identifier: Apache-2.0
// Layers of files of a marched picture.
// in: MarchState whose picture is marched -> out: planes of the layers.
// docs/formats.md, "Pictures out"; docs/raymarch.md, "Parts of the light".
#pragma once
#include "src/methods/march/march_state.h"

namespace pileus {

/// What layers of files show of a picture: parts of its light, data of whole rays. kLimit: out of
/// memory.
Status add_march_layers(const Context& context, const FrameView& view, MarchState& state);

/// What marches the picture, whose light is on nodes; nodes of a sky's own light are set where
/// there are any.
RaymarchInput march_input(const FrameView& view, const MarchState& state);
inline bool has_sky_light(const FrameView& view, const MarchState& state) {
    return state.choice.sky_nodes && view.lighting.sunlit && view.world.medium.sigma > 0;
}

/// Numbers a pixel of parts, and whether media emit, which is a part of its own.
std::uint64_t march_part_planes(const FrameView& view, const MarchState& state);
bool march_emits(const FrameView& view, const MarchState& state);

/// The launch that adds lamps and emission to the picture, whose nodes are made.
LampMarchParams march_lamps(const FrameView& view, const MarchState& state);

/// What `light` shows behind the media, into planes whose background and opaque depth are there.
Status march_background(const Context& context, const FrameView& view, const Lighting& light,
                        MarchState& state, Planes& planes);

}  // namespace pileus
