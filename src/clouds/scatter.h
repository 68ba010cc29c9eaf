// SPDX-License-Identifier: Apache-2.0
// Many clouds by random numbers, none over another.
// in: [[clouds.scatter]], the kinds' boxes, clouds that stand already -> out: places.
// docs/clouds.md, "In a scene file"
#pragma once
#include <vector>

#include "src/base/status.h"
#include "src/clouds/place.h"

namespace pileus {

/// The box of a kind, in its own metres.
struct KindBox {
    Double3 low_m{}, high_m{};
};

/// The circle that a cloud covers seen from above, whatever its turn.
struct Footprint {
    double x = 0, y = 0, radius = 0;  ///< m
};
Footprint footprint_of(const CloudPlace& place, const KindBox& box);

/// Adds `scatter.count` clouds around (x, y), of kinds by their numbers. A cloud depends on those
/// before it alone: a larger count has the same first clouds. kBadInput: no room for all of them.
Status scatter_clouds(const CloudScatter& scatter, const std::array<double, 2>& center_m,
                      const std::vector<std::size_t>& kinds, const std::vector<KindBox>& boxes,
                      std::vector<CloudPlace>& places);

}  // namespace pileus
