// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: without meshes no way between nodes is ended.
// in: nothing -> out: nothing. docs/flight.md, "Build"
#pragma once
#include <vector>

#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/ordinates/ordinates_params.h"
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/run/context.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"
#include "src/world/solids/solids.h"

namespace pileus {

struct OrdinateCells;
struct OrdinateSet;

struct OrdinateWalls {
    Buffer<OrdinateWall> ways;
    Buffer<std::int32_t> first, nodes;
    Buffer<float> sends, around;
    double ground_z = 0;

    constexpr bool any() const { return false; }
};
struct WallLight {
    float* radiance;
    const float *pass, *mean;
    const OrdinateSweep* sweeps;
    const float* enters;
    const OrdinateSet* set;
    float* sends;
    float* around;
};

inline bool is_within_solid(const Solids&, const float (&)[3]) { return false; }
inline Status place_walls(const Context&, const Solids&, double, OrdinateCells&) {
    return Status::ok();
}
inline Status hold_walls(std::uint64_t, bool, OrdinateWalls&) { return Status::ok(); }
inline void light_surfaces(const Context&, const Medium&, const Majorants&, const Lighting&,
                           const float (&)[3], OrdinateWalls&) {}
inline void keep_sources(const Context&, const OrdinateCells&, const WallLight&, OrdinateWalls&) {}
inline double light_walls(const Context&, const OrdinateCells&, const WallLight&, bool, float,
                          OrdinateWalls&) {
    return 0;
}
inline void mix_walls(const std::vector<OrdinateSet>&, OrdinateWalls&) {}
inline void shade_cells(const Context&, const Solids&, const ShadowParams&, Buffer<float>&) {}
inline AroundNodes around_nodes(const OrdinateCells&) { return {}; }

}  // namespace pileus
