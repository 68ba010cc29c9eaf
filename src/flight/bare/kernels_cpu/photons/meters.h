// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: no flight has meters.
// in: nothing -> out: a constant. docs/flight.md, "Build"
#pragma once
#include "kernels_cpu/photons/trace_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

PILEUS_FN constexpr bool is_metered(const TraceParams&) { return false; }

}  // namespace PILEUS_ISA
}  // namespace pileus
