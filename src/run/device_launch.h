// SPDX-License-Identifier: Apache-2.0
// Whole launches on a device: arrays go there, one thread runs per item, arrays come back.
// in: the structs that kernels take on the host, and sizes they do not tell -> out: the same
// arrays. docs/crosscheck.md. Nothing stays on the device between two launches.
#pragma once
#include <vector>

#include "kernels_cpu/isa/kernels.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// Items [0, count) each; `device` as in KernelTable. kLimit: the device has too little memory;
/// kIo: a copy or a launch failed.
Status launch_on_device(const DeviceTable& device, const ShadowParams& k, const ShadowBuffers& b,
                        std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const MarchParams& k, const MarchBuffers& b,
                        std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const BackgroundParams& k,
                        const BackgroundBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const SolidRowsParams& k,
                        const BackgroundBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const UpsampleParams& k,
                        const UpsampleBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const AirRowsParams& k, const AirRowsBuffers& b,
                        std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const RaymarchParams& k,
                        const RaymarchBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const RaymarchSkyParams& k,
                        const RaymarchBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const SkyLightParams& k,
                        const SkyLightBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const SkyTurnParams& k, const SkyTurnBuffers& b,
                        std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const PathParams& k, const PathBuffers& b,
                        std::uint32_t count);

/// What of two launches with the same structs is meant.
enum class LampRows { kDepths, kMarch };
Status launch_on_device(const DeviceTable& device, const LampMarchParams& k,
                        const LampMarchBuffers& b, LampRows rows, std::uint32_t count);

/// All diagonals, one after the other; k.diagonal is not read.
Status sweep_on_device(const DeviceTable& device, const SweepParams& k, const SweepBuffers& b);
/// One slice after the other, each with `taps` of its own.
struct SweepLayer {
    SweepLayerParams k;
    const SweepTap* taps;
};
Status sweep_on_device(const DeviceTable& device, Span<const SweepLayer> layers,
                       const SweepBuffers& b);

/// `numbers`: of b.sums, those of the ground, which follow the collectors', among them.
Status launch_on_device(const DeviceTable& device, const TraceParams& k, const TraceBuffers& b,
                        std::uint64_t numbers, std::uint32_t count);

/// Of `count` tiles; `spheres`: of b.spheres. b.scratch is not used.
Status launch_on_device(const DeviceTable& device, const BlendParams& k, const BlendBuffers& b,
                        std::uint64_t spheres, std::uint32_t count);

/// Procedural media: rows, columns, rows of blocks.
Status launch_on_device(const DeviceTable& device, const NoiseParams& k, const NoiseBuffers& b,
                        std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const BakeParams& k, const BakeBuffers& b,
                        std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const ColumnParams& k, const ColumnBuffers& b,
                        std::uint32_t count);
/// b.scratch is not used.
Status launch_on_device(const DeviceTable& device, const CumulusParams& k, const CumulusBuffers& b,
                        std::uint32_t count);

/// Places in any order.
Status launch_on_device(const DeviceTable& device, const ParticleDepthParams& k,
                        const ParticleDepthBuffers& b, std::uint32_t count);
/// Balls.
Status launch_on_device(const DeviceTable& device, const ParticleMarchParams& k,
                        const ParticleColourBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const ParticleLampDepths& k,
                        const ParticleLampDepthBuffers& b, std::uint32_t count);
Status launch_on_device(const DeviceTable& device, const ParticleMarchParams& k,
                        const ParticleLampLight& b, std::uint32_t count);

/// Tiles of different pixels, and what each sees of `seen`.
struct ParticleTiles {
    std::vector<ParticleTile> tiles;  ///< their `seen` is not read
    std::vector<std::int64_t> first;  ///< of each in `seen`; -1: any ball
    std::vector<ParticleSeen> seen;

    void clear() {
        tiles.clear();
        first.clear();
        seen.clear();
    }
    void add(const ParticleTile& tile) {
        tiles.push_back(tile);
        first.push_back(tile.seen != nullptr ? std::int64_t(seen.size()) : -1);
        if (tile.seen != nullptr) seen.insert(seen.end(), tile.seen, tile.seen + tile.count);
    }
};
/// b.scratch is not used.
Status launch_on_device(const DeviceTable& device, const ParticleMarchParams& k,
                        const ParticleMarchBuffers& b, const ParticleTiles& tiles);
/// `boards`: of k.boards.
Status launch_on_device(const DeviceTable& device, const ParticleBoardParams& k,
                        const ParticleBoardBuffers& b, std::uint64_t boards,
                        const ParticleTiles& tiles);

/// The digest of the math kernels as the device computes it.
Status self_test_on_device(const DeviceTable& device, std::uint64_t& digest);

}  // namespace pileus
