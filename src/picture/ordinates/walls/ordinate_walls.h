// SPDX-License-Identifier: Apache-2.0
// Solids among the nodes of discrete ordinates: ways that they end, what they send on, and the
// light that falls on them.
// in: solids, nodes -> out: OrdinateWall of each way, light around nodes beside solids.
// docs/ordinates.md, "Solids"
#pragma once
#include <array>

#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/ordinates/ordinates_params.h"
#include "src/base/buffer.h"
#include "src/plan/array.h"
#include "src/run/context.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

struct OrdinateCells;
struct OrdinateSet;

/// What ends a way to a node.
struct OrdinateSurface {
    std::int32_t node;
    std::int32_t beyond;  ///< 1: outside of the box, below its lower face; 2: beside or above it
    float at[3];          ///< a place on it, box-local metres
    float normal[3];      ///< unit, towards the node
    float albedo[3];      ///< times the share of the way's light that it ends
    float sun[3];         ///< irradiance of a sun of 1 over pi, by channel
};

struct OrdinateWalls {
    Buffer<OrdinateWall> ways;         ///< by direction, in the order of its sweep
    Buffer<OrdinateSurface> surfaces;  ///< of each way
    std::array<std::int32_t, kOrdinates + 1> first{};
    Buffer<std::int32_t> nodes;    ///< with such ways, ascending
    Buffer<std::int32_t> begin;    ///< [node with ways + 1]: in `of_node`
    Buffer<std::int32_t> of_node;  ///< ways, node by node
    Buffer<std::int32_t> number;   ///< [node]: among those with ways; -1: none
    Buffer<float> sources;         ///< [direction][node with ways]: while radiance is swept
    Buffer<float> sends;           ///< [set][way]: OrdinateWall::sends of the solution
    Buffer<float> around;          ///< [set][kAroundTerms][node with ways]: irradiance over pi
    Buffer<float> shown;           ///< [3][kAroundTerms][node with ways]: of all sets

    double ground_z = 0;  ///< that they end at
    bool any() const { return !ways.empty(); }
};

namespace arrays {
/// No more than a way by direction and node.
inline Array<OrdinateWall> ordinate_ways(std::uint64_t ways) {
    return {"ordinates: ways that solids end", ways, Stage::kMajorants, Stage::kWrite};
}
inline Array<OrdinateSurface> ordinate_surfaces(std::uint64_t ways) {
    return {"ordinates: solids at ways", ways, Stage::kMajorants, Stage::kWrite};
}
inline Array<std::int32_t> ordinate_wall_numbers(std::uint64_t numbers) {
    return {"ordinates: numbers of ways", numbers, Stage::kMajorants, Stage::kWrite};
}
inline Array<float> ordinate_wall_light(std::uint64_t numbers) {
    return {"ordinates: light of solids", numbers, Stage::kShadow, Stage::kWrite};
}
}  // namespace arrays

/// Whether a place lies within a closed solid: rays along all axes cross odd numbers of triangles
/// of one solid.
bool is_within_solid(const Solids& solids, const float (&at)[3]);

/// Finds the ways that solids end, nodes.walls. `ground_z`: m, box-local; -infinity without.
/// kLimit: out of memory.
Status place_walls(const Context& context, const Solids& solids, double ground_z,
                   OrdinateCells& nodes);

/// Memory for so many sets; `around`: for the light around nodes, too. kLimit: out of memory.
Status hold_walls(std::uint64_t sets, bool around, OrdinateWalls& walls);

/// Sunlight on what ends ways. `rest`: share of the extinction that counts, by channel.
void light_surfaces(const Context& context, const Medium& medium, const Majorants& majorants,
                    const Lighting& lighting, const float (&rest)[3], OrdinateWalls& walls);

/// One solution's light on solids while it is solved for.
struct WallLight {
    float* radiance;  ///< [direction][place] after a sweep; set to 0 again in nodes without medium
    const float *pass, *mean;     ///< as in OrdinatesBuffers
    const OrdinateSweep* sweeps;  ///< [direction]
    const float* enters;          ///< [direction]
    const OrdinateSet* set;
    float* sends;   ///< [way], out
    float* around;  ///< [kAroundTerms][node with ways], out; null: not wanted
};
/// Sources of nodes beside solids, before a sweep.
void keep_sources(const Context& context, const OrdinateCells& nodes, const WallLight& light,
                  OrdinateWalls& walls);

/// What solids send on of the radiance that leaves the nodes beside them; `begins`: light of `mean`
/// from all sides in its place. Returns its change over its norm.
double light_walls(const Context& context, const OrdinateCells& nodes, const WallLight& light,
                   bool begins, float mean, OrdinateWalls& walls);

/// Light of all sets around nodes, by their colours.
void mix_walls(const std::vector<OrdinateSet>& sets, OrdinateWalls& walls);

/// Cells of the ground that solids keep the sun from: their depth towards it becomes endless.
void shade_cells(const Context& context, const Solids& solids, const ShadowParams& cells,
                 Buffer<float>& depth);

/// For the picture of solids: none where there are no ways.
AroundNodes around_nodes(const OrdinateCells& nodes);

}  // namespace pileus
