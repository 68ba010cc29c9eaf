// SPDX-License-Identifier: Apache-2.0
// The table of kernels: one per instruction set, all giving the same bits.
// in: a name or nothing -> out: functions over index ranges; threads live in the caller.
// docs/architecture.md, "Kernels: written once".
#pragma once
#include "kernels_cpu/display/air_params.h"
#include "kernels_cpu/display/blend_params.h"
#include "kernels_cpu/display/finish_params.h"
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/display/pixel_params.h"
#include "kernels_cpu/display/upsample_params.h"
#include "kernels_cpu/isa/device_kernels.h"
#include "kernels_cpu/light/sweep_params.h"
#include "kernels_cpu/particles/particle_params.h"
#include "kernels_cpu/path/path_params.h"
#include "kernels_cpu/photons/pack_params.h"
#include "kernels_cpu/photons/trace_params.h"
#include "kernels_cpu/procedural/sky_params.h"
#include "kernels_cpu/raymarch/lamp_march_params.h"
#include "kernels_cpu/raymarch/raymarch_detail_params.h"
#include "kernels_cpu/raymarch/raymarch_params.h"
#include "kernels_cpu/raymarch/sky_turn_params.h"
#include "kernels_cpu/solids/solids_params.h"

namespace pileus {

struct KernelTable {
    const char* name;
    int width;
    void (*trace)(const TraceParams&, const TraceBuffers&, std::uint32_t begin, std::uint32_t end);
    void (*shadow_rows)(const ShadowParams&, const ShadowBuffers&, std::uint32_t, std::uint32_t);
    void (*march_rows)(const MarchParams&, const MarchBuffers&, std::uint32_t, std::uint32_t);
    void (*background_rows)(const BackgroundParams&, const BackgroundBuffers&, std::uint32_t,
                            std::uint32_t);
    void (*blend_tile)(const BlendParams&, const BlendBuffers&, std::uint32_t, std::uint32_t);
    /// Samples [begin, end) of the launch; stores each, adds none up.
    void (*trace_paths)(const PathParams&, const PathBuffers&, std::uint32_t begin,
                        std::uint32_t end);
    /// FNV-1a 64 of every math kernel on 64 fixed inputs; the same on every machine.
    std::uint64_t (*self_test)();
    /// Where set, the functions above are not called: whole launches go to the device.
    const DeviceTable* device = nullptr;
    // On the host alone, null beside a device:
    void (*raymarch_rows)(const RaymarchParams&, const RaymarchBuffers&, std::uint32_t,
                          std::uint32_t) = nullptr;
    /// As trace_paths where there are solids or an image of them.
    void (*trace_paths_solid)(const PathParams&, const PathBuffers&, std::uint32_t begin,
                              std::uint32_t end) = nullptr;
    /// As background_rows where there are solid meshes.
    void (*solid_rows)(const SolidRowsParams&, const BackgroundBuffers&, std::uint32_t begin,
                       std::uint32_t end) = nullptr;
    /// One block of the sun's optical depth; blocks nearer the sun must be done.
    void (*sweep_block)(const SweepParams&, const SweepBuffers&, std::uint32_t block) = nullptr;
    /// Rows of one slice of a periodic medium; the slice above it must be done.
    void (*sweep_layer_rows)(const SweepLayerParams&, const SweepBuffers&, std::uint32_t begin,
                             std::uint32_t end) = nullptr;
    const SkyKernels* sky = nullptr;  ///< procedural skies
    /// Rows of a picture of which a lattice of pixels was marched.
    void (*upsample_rows)(const UpsampleParams&, const UpsampleBuffers&, std::uint32_t begin,
                          std::uint32_t end) = nullptr;
    /// As trace_paths and trace_paths_solid where PathParams::guide is on or the sun is a disc.
    void (*trace_paths_guided)(const PathParams&, const PathBuffers&, std::uint32_t begin,
                               std::uint32_t end) = nullptr;
    const ParticleKernels* particles = nullptr;  ///< of method particles
    /// As trace_paths_guided, for scenes with lamps or media that emit.
    void (*trace_paths_lamps)(const PathParams&, const PathBuffers&, std::uint32_t begin,
                              std::uint32_t end) = nullptr;
    const LampKernels* lamps = nullptr;  ///< marched light of point, spot and parallel lights
    /// Rows of a picture as 8-bit pixels.
    void (*pixel_rows)(const PixelParams&, const PixelBuffers&, std::uint32_t begin,
                       std::uint32_t end) = nullptr;
    const PackKernels* pack = nullptr;  ///< sums of photons, for a ring of generations
    /// Rows of 8-bit pixels from marched ones, with what is behind them.
    void (*finish_rows)(const FinishParams&, const FinishBuffers&, std::uint32_t begin,
                        std::uint32_t end) = nullptr;
    /// Rows of a picture through the air.
    void (*air_rows)(const AirRowsParams&, const AirRowsBuffers&, std::uint32_t begin,
                     std::uint32_t end) = nullptr;
    /// Nodes of skylight as a camera sees it.
    void (*turn_sky)(const SkyTurnParams&, const SkyTurnBuffers&, std::uint32_t begin,
                     std::uint32_t end) = nullptr;
    const DetailKernels* detail = nullptr;  ///< marches through media with detail
};

/// The widest table this machine runs; `name` (or null) forces one. Null: no such table here.
const KernelTable* kernel_table(const char* name);

/// Kernels of procedural densities: those of `table`, or of the host's widest where that is null or
/// a device's.
inline const SkyKernels& sky_kernels(const KernelTable* table) {
    return table != nullptr && table->sky != nullptr ? *table->sky : *kernel_table(nullptr)->sky;
}

/// Table number i of those compiled in and runnable here, narrowest first; null past the end.
const KernelTable* kernel_table_at(int i);

/// What self_test must give.
std::uint64_t expected_self_test();

}  // namespace pileus
