// SPDX-License-Identifier: Apache-2.0
// Which nodes of a grid over a medium a march can read: those beside medium.
// in: a grid of nodes, blocks of largest densities -> out: a range of nodes for each row.
#pragma once
#include <vector>

#include "kernels_cpu/display/march_params.h"

namespace pileus {

/// For each row of nodes, y fastest, those that are read for places with medium. All of them in a
/// periodic medium and where `medium` has no density.
std::vector<NodeRange> nodes_in_medium(const NodeGrid& nodes, const MediumView& medium);

}  // namespace pileus
