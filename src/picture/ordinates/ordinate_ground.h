// SPDX-License-Identifier: Apache-2.0
// What a medium sends to the ground of a solution, and what the ground sends back.
// in: a solution, a ground, the sun -> out: light on a map of the ground; the ground's mean
// radiance. docs/ordinates.md, "Ground"
#pragma once
#include "src/picture/ordinates/ordinate_solve.h"

namespace pileus {

/// Whether the ground is lit: it lies below the medium's top.
bool lights_ground(const Medium& medium, const Lighting& lighting, const OrdinateAsk& ask,
                   const OrdinateCells& nodes);

/// The map: the box and twice its height over the ground on all sides, or one period. Where it is
/// another than before, no set is known any more. kLimit: out of memory.
Status place_ground(const Context& context, const Medium& medium, const Lighting& lighting,
                    OrdinateNodes& nodes);

/// Light of set `s` on the map, from what leaves the nodes. The set is solved. kLimit: out of
/// memory.
Status light_ground(const Context& context, const Medium& medium, const Lighting& lighting,
                    const OrdinateSources& from, std::size_t s, OrdinateSolver& solver,
                    OrdinateNodes& nodes);

/// The radiance of the map, and the ground's mean, which is the colour of its sets: as much as
/// reaches it below the medium, with what it has sent up itself. kLimit: out of memory.
Status mix_ground(const Context& context, const Medium& medium, const Majorants& majorants,
                  const Lighting& lighting, OrdinateNodes& nodes);

/// Cells of the map, at most.
std::uint64_t max_ground_cells(const Medium& medium);

/// Memory for any light. kLimit: out of memory.
Status reserve_ground(OrdinateNodes& nodes);

/// The background reads it, and solids below the media, which have what the ground has; those among
/// nodes have what comes through these.
void read_ordinate_light(const OrdinateNodes& nodes, const Lighting& light, BackgroundParams& k,
                         BackgroundBuffers& b);

}  // namespace pileus
