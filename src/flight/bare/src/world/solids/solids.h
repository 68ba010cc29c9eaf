// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: a flight has no meshes.
// in: nothing -> out: nothing. docs/flight.md, "Build"
#pragma once
#include "kernels_cpu/solids/solids_params.h"
#include "src/plan/plan.h"
#include "src/plan/report.h"
#include "src/run/context.h"
#include "src/scene/scene.h"

namespace pileus {

struct Solids {
    static constexpr bool meshes = false;
    constexpr std::uint64_t bytes() const { return 0; }
    constexpr bool empty() const { return true; }
    constexpr bool coloured() const { return false; }
    SolidsView view() const { return {}; }
};

struct CameraDepth;

inline void add_solid_rows(const Scene&, const Limits&, const Solids&, const CameraDepth&,
                           MemoryTable&) {}
inline void report_solids(const Solids&, const CameraDepth&, Report&) {}

}  // namespace pileus
