// SPDX-License-Identifier: Apache-2.0
// The path tracer lit by point, spot and parallel lights, compiled once per instruction set, apart
// from others. in: the kernel templates -> out: one exported function, named after the instruction
// set. docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing
// leaks.
#include "kernels_cpu/path/path.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_PATH_LAMPS(isa) PILEUS_JOIN(path_lamps_, isa)

namespace pileus {

void PILEUS_PATH_LAMPS(PILEUS_ISA)(const PathParams&, const PathBuffers&, std::uint32_t,
                                   std::uint32_t);
void PILEUS_PATH_LAMPS(PILEUS_ISA)(const PathParams& k, const PathBuffers& b, std::uint32_t begin,
                                   std::uint32_t end) {
    trace_paths_lamps<PILEUS_WIDTH>(k, b, begin, end);
}

}  // namespace pileus
