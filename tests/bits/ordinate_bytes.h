// SPDX-License-Identifier: Apache-2.0
// Bytes that nodes of discrete ordinates hold, by the rows of a plan.
// in: nodes -> out: sizes by name.
#pragma once
#include <map>
#include <string>

#include "src/picture/ordinates/ordinates.h"

namespace pileus {

inline void add_ordinates(const OrdinateNodes& ordinates,
                          std::map<std::string, std::uint64_t>& held) {
    held["ordinates: moments on nodes"] = ordinates.solution.bytes();
    held["ordinates: light on nodes"] = ordinates.light.bytes();
    held["ordinates: light near the camera"] = ordinates.near.bytes();
    held["ordinates: density within nodes"] = ordinates.samples.bytes();
    held["ordinates: numbers of nodes"] = ordinates.density.bytes();
    {
        const OrdinateHalf& half = ordinates.half;
        const OrdinateCells& larger = half.nodes;
        held["ordinates: moments on larger nodes"] =
            larger.solution.bytes() + half.correction.bytes();
        held["ordinates: larger nodes"] = larger.density.bytes() + larger.filled.bytes() +
                                          half.number.bytes() + half.parent.bytes() +
                                          half.share.bytes();
        held["ordinates: parts in larger nodes"] = larger.parts.bytes();
    }
    held["ordinates: light on the ground"] = ordinates.ground.light.bytes() +
                                             ordinates.ground.radiance.bytes() +
                                             ordinates.ground.into.bytes();
    held["ordinates: places of nodes"] = ordinates.filled.bytes();
    held["ordinates: rim of nodes"] = ordinates.rim.bytes();
    held["ordinates: parts of the media"] = ordinates.parts.bytes();
    held["ordinates: parts of the sun"] = ordinates.sunward.bytes();
    held["ordinates: shadow of solids"] = ordinates.seen.bytes();
    {
        const OrdinateWalls &own = ordinates.walls, &larger = ordinates.half.nodes.walls;
        held["ordinates: ways that solids end"] = own.ways.bytes() + larger.ways.bytes();
        held["ordinates: solids at ways"] = own.surfaces.bytes() + larger.surfaces.bytes();
        for (const OrdinateWalls* w : {&own, &larger})
            held["ordinates: numbers of ways"] +=
                w->nodes.bytes() + w->begin.bytes() + w->of_node.bytes() + w->number.bytes();
        held["ordinates: light of solids"] = own.sends.bytes() + own.around.bytes() +
                                             own.shown.bytes() + larger.sends.bytes() +
                                             own.sources.bytes() + larger.sources.bytes();
    }
    held["beam by angle and depth"] = ordinates.peak.tables.bytes();
}

}  // namespace pileus
