// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set with PILEUS_ISA (a name) and PILEUS_WIDTH (lanes).
// in: the kernel templates -> out: one exported table, everything else internal.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#include "kernels_cpu/core/profile.h"
#include "kernels_cpu/display/blend.h"
#include "kernels_cpu/display/march.h"
#include "kernels_cpu/display/march_background.h"
#include "kernels_cpu/isa/kernels.h"
#include "kernels_cpu/isa/self_test.h"
#include "kernels_cpu/photons/trace.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) a##b
#define PILEUS_TRACE_SOLIDS(isa) PILEUS_JOIN(trace_solids_, isa)
#define PILEUS_TRACE_CELLS(isa) PILEUS_JOIN(trace_cells_, isa)

namespace pileus {

/// Of isa_trace_solids.cpp, compiled for the same instruction set.
void PILEUS_TRACE_SOLIDS(PILEUS_ISA)(const TraceParams&, const TraceBuffers&, std::uint32_t,
                                     std::uint32_t);
/// Of isa_trace_cells.cpp.
void PILEUS_TRACE_CELLS(PILEUS_ISA)(const TraceParams&, const TraceBuffers&, std::uint32_t,
                                    std::uint32_t);

namespace {

#ifdef PILEUS_WITHOUT_PHOTONS
constexpr bool kPhotons = false;
#else
constexpr bool kPhotons = true;
#endif
#ifdef PILEUS_WITHOUT_BILLBOARDS
constexpr bool kBillboards = false;
#else
constexpr bool kBillboards = true;
#endif
#ifdef PILEUS_WITHOUT_MARCH
constexpr bool kMarch = false;
#else
constexpr bool kMarch = true;
#endif

static_assert(__FLT_EVAL_METHOD__ == 0, "floats must be computed as floats");

void trace_kernel(const TraceParams& k, const TraceBuffers& b, std::uint32_t begin,
                  std::uint32_t end) {
    if (!kPhotons) return;
    if (k.cells[0] > 0) return PILEUS_TRACE_CELLS(PILEUS_ISA)(k, b, begin, end);
    if (kMeshes && k.solids.count > 0) return PILEUS_TRACE_SOLIDS(PILEUS_ISA)(k, b, begin, end);
    trace<PILEUS_WIDTH>(k, b, begin, end);
}
void shadow_kernel(const ShadowParams& k, const ShadowBuffers& b, std::uint32_t begin,
                   std::uint32_t end) {
    shadow_rows<PILEUS_WIDTH>(k, b, begin, end);
}
void march_kernel(const MarchParams& k, const MarchBuffers& b, std::uint32_t begin,
                  std::uint32_t end) {
    if (kMarch) march_rows<PILEUS_WIDTH>(k, b, begin, end);
}
void background_kernel(const BackgroundParams& k, const BackgroundBuffers& b, std::uint32_t begin,
                       std::uint32_t end) {
    background_rows<PILEUS_WIDTH>(k, b, begin, end);
}
void blend_kernel(const BlendParams& k, const BlendBuffers& b, std::uint32_t begin,
                  std::uint32_t end) {
    if (kBillboards) blend_tile<PILEUS_WIDTH>(k, b, begin, end);
}
std::uint64_t self_test_kernel() { return self_test_digest<PILEUS_WIDTH>(); }

}  // namespace

#define PILEUS_QUOTE(name) #name
#define PILEUS_NAME(name) PILEUS_QUOTE(name)
#define PILEUS_TABLE(isa) PILEUS_JOIN(kernel_table_, isa)
#define PILEUS_PATH(isa) PILEUS_JOIN(path_kernel_, isa)
#define PILEUS_SKY(isa) PILEUS_JOIN(sky_kernel_, isa)
#define PILEUS_RAYMARCH(isa) PILEUS_JOIN(raymarch_kernel_, isa)
#define PILEUS_UPSAMPLE(isa) PILEUS_JOIN(upsample_kernel_, isa)
#define PILEUS_PIXELS(isa) PILEUS_JOIN(pixel_kernel_, isa)
#define PILEUS_FINISH(isa) PILEUS_JOIN(finish_kernel_, isa)
#define PILEUS_AIR(isa) PILEUS_JOIN(air_kernel_, isa)
#define PILEUS_TURN_SKY(isa) PILEUS_JOIN(turn_sky_kernel_, isa)
#define PILEUS_SWEEP(isa) PILEUS_JOIN(sweep_kernel_, isa)
#define PILEUS_SWEEP_LAYER(isa) PILEUS_JOIN(sweep_layer_kernel_, isa)
#define PILEUS_PATH_SOLIDS(isa) PILEUS_JOIN(path_solids_, isa)
#define PILEUS_PATH_GUIDED(isa) PILEUS_JOIN(path_guided_, isa)
#define PILEUS_PATH_LAMPS(isa) PILEUS_JOIN(path_lamps_, isa)
#define PILEUS_LAMPS(isa) PILEUS_JOIN(lamp_kernel_, isa)
#define PILEUS_PARTICLES(isa) PILEUS_JOIN(particle_kernel_, isa)
#define PILEUS_SOLIDS(isa) PILEUS_JOIN(solid_rows_, isa)
#define PILEUS_PACK(isa) PILEUS_JOIN(pack_kernel_, isa)
#define PILEUS_DETAIL(isa) PILEUS_JOIN(detail_kernel_, isa)

/// Of isa_path.cpp, compiled for the same instruction set.
void PILEUS_PATH(PILEUS_ISA)(const PathParams&, const PathBuffers&, std::uint32_t, std::uint32_t);
/// Of isa_raymarch.cpp.
void PILEUS_RAYMARCH(PILEUS_ISA)(const RaymarchParams&, const RaymarchBuffers&, std::uint32_t,
                                 std::uint32_t);
/// Of isa_path_solids.cpp.
void PILEUS_PATH_SOLIDS(PILEUS_ISA)(const PathParams&, const PathBuffers&, std::uint32_t,
                                    std::uint32_t);
/// Of isa_path_guided.cpp.
void PILEUS_PATH_GUIDED(PILEUS_ISA)(const PathParams&, const PathBuffers&, std::uint32_t,
                                    std::uint32_t);
/// Of isa_path_lamps.cpp.
void PILEUS_PATH_LAMPS(PILEUS_ISA)(const PathParams&, const PathBuffers&, std::uint32_t,
                                   std::uint32_t);
/// Of isa_sky.cpp.
extern const SkyKernels PILEUS_SKY(PILEUS_ISA);

/// Of isa_lamps.cpp.
extern const LampKernels PILEUS_LAMPS(PILEUS_ISA);

/// Of isa_particles.cpp.
extern const ParticleKernels PILEUS_PARTICLES(PILEUS_ISA);

/// Of isa_pack.cpp.
extern const PackKernels PILEUS_PACK(PILEUS_ISA);

/// Of isa_detail.cpp.
extern const DetailKernels PILEUS_DETAIL(PILEUS_ISA);

/// Of isa_upsample.cpp and isa_sweep.cpp, likewise.
void PILEUS_UPSAMPLE(PILEUS_ISA)(const UpsampleParams&, const UpsampleBuffers&, std::uint32_t,
                                 std::uint32_t);
void PILEUS_PIXELS(PILEUS_ISA)(const PixelParams&, const PixelBuffers&, std::uint32_t,
                               std::uint32_t);
void PILEUS_FINISH(PILEUS_ISA)(const FinishParams&, const FinishBuffers&, std::uint32_t,
                               std::uint32_t);
void PILEUS_TURN_SKY(PILEUS_ISA)(const SkyTurnParams&, const SkyTurnBuffers&, std::uint32_t,
                                 std::uint32_t);
void PILEUS_AIR(PILEUS_ISA)(const AirRowsParams&, const AirRowsBuffers&, std::uint32_t,
                            std::uint32_t);
void PILEUS_SWEEP(PILEUS_ISA)(const SweepParams&, const SweepBuffers&, std::uint32_t);
void PILEUS_SWEEP_LAYER(PILEUS_ISA)(const SweepLayerParams&, const SweepBuffers&, std::uint32_t,
                                    std::uint32_t);

/// Of isa_solids.cpp.
void PILEUS_SOLIDS(PILEUS_ISA)(const SolidRowsParams&, const BackgroundBuffers&, std::uint32_t,
                               std::uint32_t);

extern const KernelTable PILEUS_TABLE(PILEUS_ISA);
const KernelTable PILEUS_TABLE(PILEUS_ISA) = {
    PILEUS_NAME(PILEUS_ISA),
    PILEUS_WIDTH,
    trace_kernel,
    shadow_kernel,
    march_kernel,
    background_kernel,
    blend_kernel,
    PILEUS_PATH(PILEUS_ISA),
    self_test_kernel,
    nullptr,
    PILEUS_RAYMARCH(PILEUS_ISA),
    PILEUS_PATH_SOLIDS(PILEUS_ISA),
    PILEUS_SOLIDS(PILEUS_ISA),
    PILEUS_SWEEP(PILEUS_ISA),
    PILEUS_SWEEP_LAYER(PILEUS_ISA),
    &PILEUS_SKY(PILEUS_ISA),
    PILEUS_UPSAMPLE(PILEUS_ISA),
    PILEUS_PATH_GUIDED(PILEUS_ISA),
    &PILEUS_PARTICLES(PILEUS_ISA),
    PILEUS_PATH_LAMPS(PILEUS_ISA),
    &PILEUS_LAMPS(PILEUS_ISA),
    PILEUS_PIXELS(PILEUS_ISA),
    &PILEUS_PACK(PILEUS_ISA),
    PILEUS_FINISH(PILEUS_ISA),
    PILEUS_AIR(PILEUS_ISA),
    PILEUS_TURN_SKY(PILEUS_ISA),
    &PILEUS_DETAIL(PILEUS_ISA),
};

}  // namespace pileus
