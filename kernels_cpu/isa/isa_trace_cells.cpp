// SPDX-License-Identifier: Apache-2.0
// Photons whose light a regular grid gathers, compiled once per instruction set, apart from others.
// in: the kernel templates -> out: one exported function, named after the instruction set.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/core/profile.h"
#include "kernels_cpu/photons/trace.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_TRACE_CELLS(isa) PILEUS_JOIN(trace_cells_, isa)

namespace pileus {

void PILEUS_TRACE_CELLS(PILEUS_ISA)(const TraceParams&, const TraceBuffers&, std::uint32_t,
                                    std::uint32_t);
void PILEUS_TRACE_CELLS(PILEUS_ISA)(const TraceParams& k, const TraceBuffers& b,
                                    std::uint32_t begin, std::uint32_t end) {
    if (kMeshes && k.solids.count > 0) return trace<PILEUS_WIDTH, true, true>(k, b, begin, end);
    trace<PILEUS_WIDTH, false, true>(k, b, begin, end);
}

}  // namespace pileus
