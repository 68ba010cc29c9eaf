// SPDX-License-Identifier: Apache-2.0
// What is known of each pixel without noise, for the filter: one march with light on nodes.
// in: a medium, the sun, lamps, a camera -> out: transmittance and depths; the sun's light, seen
// thrice, or twice and that of lamps.
// docs/filter.md
#pragma once
#include "src/picture/march_view.h"

namespace pileus {

/// Planes of a march: the sun's light scattered once, and what of it reaches places that see more
/// of the sun than straight ways tell, as light that was scattered often does.
constexpr int kGuidePlanes = 3;

/// Shares of the extinction towards the sun in the two others.
constexpr float kGuideShares[kGuidePlanes - 1] = {0.2f, 0.04f};

/// Lamps whose light is among the guides, at most: those that light the box's middle most.
constexpr std::size_t kMaxGuidingLamps = 16;

struct FilterGuides {
    NodeGrid nodes{};
    Buffer<float> sun_depth;   ///< [node], optical depth to the sun
    Buffer<float> visibility;  ///< [node], of solid_shadow.h; empty without solids
    Buffer<float> quads;       ///< [node][4]
    Buffer<float> planes;      ///< [kGuidePlanes][pixel]
};

namespace arrays {

/// Numbers of the guides' nodes, with or without those of solids.
Array<float> guide_nodes(const Medium& medium, bool solids);
/// Nodes of as many of so many lamps as guide.
Array<float> guide_lamps(const Medium& medium, std::size_t lamps);
inline Array<float> guide_planes(std::uint64_t pixels) {
    return {"guides of the filter", bytes_of(kGuidePlanes, pixels), Stage::kPaths, Stage::kLayers};
}

}  // namespace arrays

/// As march_medium, with its bits, and the guides beside. Optical depths are always stored. Needs
/// kernels of the host. kLimit: out of memory.
Status march_guides(const Context& context, const Medium& medium, const Majorants& majorants,
                    const Lighting& lighting, const CameraParams& camera, bool half_depth,
                    Planes& planes, FilterGuides& guides);

}  // namespace pileus
