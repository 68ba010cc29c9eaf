// SPDX-License-Identifier: Apache-2.0
// What enters nodes at a ring around them: light of coarser nodes.
// in: a solution on coarser nodes -> out: radiance on the ring, and a start for the nodes within.
// docs/ordinates.md, "Skies"
#pragma once
#include "src/picture/ordinates/ordinate_solve.h"

namespace pileus {

/// Of set `s`: from.ring, in `ring`, and where its solution `begins` the set's moments, in
/// nodes.solution. kLimit: out of memory.
Status light_ring(const Context& context, const OrdinateCoarser& coarser, std::size_t s,
                  bool begins, OrdinateCells& nodes, Buffer<float>& ring, OrdinateSources& from);

}  // namespace pileus
