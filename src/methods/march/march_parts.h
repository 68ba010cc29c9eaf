// SPDX-License-Identifier: Apache-2.0
// Parts of a marched picture's light.
// in: MarchState whose picture is marched -> out: planes of the layers light and order.
// docs/formats.md, "Pictures out"; docs/raymarch.md, "Parts of the light".
#pragma once
#include "src/methods/march/march_state.h"

namespace pileus {

/// Planes of the parts that layers show; `whole` marched the picture. kLimit: out of memory.
Status march_parts(const Context& context, const FrameView& view, const RaymarchInput& whole,
                   MarchState& state);

/// Data of whole rays, where layers show them: after all that looks at where colours end. kLimit:
/// out of memory.
Status follow_march(const Context& context, const FrameView& view, const RaymarchInput& whole,
                    MarchState& state);

/// Numbers a pixel of parts, and whether media emit, which is a part of its own.
std::uint64_t march_part_planes(const FrameView& view, const MarchState& state);
bool march_emits(const FrameView& view, const MarchState& state);

/// The launch that adds lamps and emission to the picture, whose nodes are made.
LampMarchParams march_lamps(const FrameView& view, const MarchState& state);

/// What `light` shows behind the media, into planes whose background and opaque depth are there.
Status march_background(const Context& context, const FrameView& view, const Lighting& light,
                        MarchState& state, Planes& planes);

}  // namespace pileus
