// SPDX-License-Identifier: Apache-2.0
// Stands in for kernels that a library was configured without, so that the table of the others is
// whole. in: PILEUS_WITHOUT_<PART>, PILEUS_ISA -> out: functions that nothing calls: what would
// need them is refused before. cmake/PileusFlight.cmake; docs/flight.md, "Build"
#include "kernels_cpu/isa/kernels.h"

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_OF(kernel, isa) PILEUS_JOIN(kernel, isa)
#define PILEUS_NOTHING(kernel, Params, Buffers)                                      \
    void PILEUS_OF(kernel, PILEUS_ISA)(const Params&, const Buffers&, std::uint32_t, \
                                       std::uint32_t);                               \
    void PILEUS_OF(kernel, PILEUS_ISA)(const Params&, const Buffers&, std::uint32_t, \
                                       std::uint32_t) {}
#define PILEUS_NO_TABLE(kernel, Table)                \
    extern const Table PILEUS_OF(kernel, PILEUS_ISA); \
    const Table PILEUS_OF(kernel, PILEUS_ISA) = {};

namespace pileus {

#ifdef PILEUS_WITHOUT_SOLIDS
PILEUS_NOTHING(trace_solids_, TraceParams, TraceBuffers)
PILEUS_NOTHING(solid_rows_, SolidRowsParams, BackgroundBuffers)
#endif
#ifdef PILEUS_WITHOUT_CELLS
PILEUS_NOTHING(trace_cells_, TraceParams, TraceBuffers)
#endif
#ifdef PILEUS_WITHOUT_PATH
PILEUS_NOTHING(path_kernel_, PathParams, PathBuffers)
PILEUS_NOTHING(path_solids_, PathParams, PathBuffers)
PILEUS_NOTHING(path_guided_, PathParams, PathBuffers)
#endif
#if defined(PILEUS_WITHOUT_PATH) || defined(PILEUS_WITHOUT_LIGHTS)
PILEUS_NOTHING(path_lamps_, PathParams, PathBuffers)
#endif
#if defined(PILEUS_WITHOUT_LAMPS) || defined(PILEUS_WITHOUT_LIGHTS)
PILEUS_NO_TABLE(lamp_kernel_, LampKernels)
#endif
#ifdef PILEUS_WITHOUT_PHOTONS
PILEUS_NO_TABLE(pack_kernel_, PackKernels)
#endif
#ifdef PILEUS_WITHOUT_RAYMARCH
PILEUS_NOTHING(raymarch_kernel_, RaymarchParams, RaymarchBuffers)
#endif
#ifdef PILEUS_WITHOUT_SWEEP
void PILEUS_OF(sweep_kernel_, PILEUS_ISA)(const SweepParams&, const SweepBuffers&, std::uint32_t);
void PILEUS_OF(sweep_kernel_, PILEUS_ISA)(const SweepParams&, const SweepBuffers&, std::uint32_t) {}
PILEUS_NOTHING(sweep_layer_kernel_, SweepLayerParams, SweepBuffers)
PILEUS_NOTHING(turn_sky_kernel_, SkyTurnParams, SkyTurnBuffers)
#endif
#ifdef PILEUS_WITHOUT_SKY
PILEUS_NO_TABLE(sky_kernel_, SkyKernels)
#endif
#ifdef PILEUS_WITHOUT_DETAIL
PILEUS_NO_TABLE(detail_kernel_, DetailKernels)
#endif
#ifdef PILEUS_WITHOUT_PARTICLES
PILEUS_NO_TABLE(particle_kernel_, ParticleKernels)
#endif

}  // namespace pileus
