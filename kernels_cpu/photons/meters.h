// SPDX-License-Identifier: Apache-2.0
// Whether photons are metered: a flight, which has no meters, is compiled with a header in place of
// this. in: a launch -> out: whether it fills meters. docs/flight.md, "Build"
#pragma once
#include "kernels_cpu/photons/meter_params.h"
#include "kernels_cpu/photons/trace_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

PILEUS_FN bool is_metered(const TraceParams& k) { return k.mode == kDepositAbsorbed; }

}  // namespace PILEUS_ISA
}  // namespace pileus
