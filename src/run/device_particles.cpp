// SPDX-License-Identifier: Apache-2.0
// See device_launch.h: light on particles, and pictures of them.
// in: structs of one launch -> out: the same with the device's pointers; results copied back.
// docs/crosscheck.md
#include "src/run/device_launch.h"
#include "src/run/device_views.h"

namespace pileus {
namespace {

using Size = DeviceSize;

/// Returns the number of balls, which the node behind the last one tells.
Size add_view(DeviceArrays& a, ParticleView& view) {
    const Size nodes = Size(view.node_count);
    const Size balls = view.nodes != nullptr ? Size(view.nodes[nodes].first) : 0;
    a.in(view.nodes, nodes + 1);
    a.in(view.balls, balls);
    return balls;
}

/// The device's tiles, each with its part of the device's list.
void add_tiles(DeviceArrays& a, const ParticleTiles& from, std::vector<ParticleTile>& own,
               const ParticleTile*& tiles) {
    const ParticleSeen* seen = from.seen.data();
    a.in(seen, from.seen.size());
    own = from.tiles;
    for (std::size_t i = 0; i < own.size(); ++i) {
        own[i].seen = nullptr;
        if (from.first[i] >= 0 && seen != nullptr) own[i].seen = seen + from.first[i];
    }
    tiles = own.data();
    a.in(tiles, own.size());
}

}  // namespace

Status launch_on_device(const DeviceTable& device, const ParticleDepthParams& params,
                        const ParticleDepthBuffers& buffers, std::uint32_t count) {
    ParticleDepthParams k = params;
    ParticleDepthBuffers b = buffers;
    DeviceArrays a(*device.device);
    a.in(k.occluders, Size(k.count));
    a.in(b.u, count);
    a.in(b.v, count);
    a.in(b.w, count);
    a.both(b.depth, count);
    a.launch(device.kernels->particle_depths, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const ParticleMarchParams& params,
                        const ParticleColourBuffers& buffers, std::uint32_t count) {
    ParticleMarchParams k = params;
    ParticleColourBuffers b = buffers;
    DeviceArrays a(*device.device);
    (void)add_view(a, k.view);
    a.in(k.phase.table);
    a.in(b.shade, b.balls);
    a.in(b.sky, 3 * b.balls);
    a.in(b.seen, b.balls);
    a.in(b.tint, 3 * b.balls);
    a.both(b.boards, b.balls);
    a.launch(device.kernels->board_colours, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const ParticleLampDepths& params,
                        const ParticleLampDepthBuffers& buffers, std::uint32_t count) {
    ParticleLampDepths k = params;
    ParticleLampDepthBuffers b = buffers;
    DeviceArrays a(*device.device);
    a.both(b.depth, add_view(a, k.view));
    a.launch(device.kernels->particle_lamp_depths, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const ParticleMarchParams& params,
                        const ParticleLampLight& buffers, std::uint32_t count) {
    ParticleMarchParams k = params;
    ParticleLampLight b = buffers;
    DeviceArrays a(*device.device);
    (void)add_view(a, k.view);
    a.in(k.phase.table);
    const Size pairs = Size(b.count) * b.balls;
    a.in(b.lamps, Size(b.count));
    a.in(b.depth, pairs);
    a.in(b.reach, pairs);
    a.in(b.seen, pairs);
    a.in(b.sky, 3 * b.balls);
    a.in(b.tint, 3 * b.balls);
    a.both(b.light, 3 * b.balls);
    a.launch(device.kernels->particle_lamp_light, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const ParticleMarchParams& params,
                        const ParticleMarchBuffers& buffers, const ParticleTiles& tiles) {
    ParticleMarchParams k = params;
    ParticleTileBuffers b{buffers, nullptr};
    DeviceArrays a(*device.device);
    (void)add_view(a, k.view);
    a.in(k.phase.table);
    const Size pixels = pixels_in(k.camera);
    a.in(b.march.shade, b.march.balls);
    a.in(b.march.sky, 3 * b.march.balls);
    a.in(b.march.seen, b.march.balls);
    a.in(b.march.tint, 3 * b.march.balls);
    a.in(b.march.opaque_depth, pixels);
    a.both(b.march.transmittance, pixels);
    a.both(b.march.colour, 3 * pixels);
    a.both(b.march.half_depth, pixels);
    a.both(b.march.optical_depth, pixels);
    std::vector<ParticleTile> own;
    add_tiles(a, tiles, own, b.tiles);
    const std::uint32_t count = std::uint32_t(own.size());
    const Size share = particle_scratch_share(k.bins);
    const std::uint32_t step = items_at_once(count, share);
    a.zeros(b.march.scratch, step * share);
    for (std::uint32_t begin = 0; begin < count; begin += step)
        a.launch(device.kernels->particle_tiles, k, b, begin,
                 count - begin < step ? count : begin + step);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const ParticleBoardParams& params,
                        const ParticleBoardBuffers& buffers, std::uint64_t boards,
                        const ParticleTiles& tiles) {
    ParticleBoardParams k = params;
    ParticleBoardTileBuffers b{buffers, nullptr};
    DeviceArrays a(*device.device);
    const Size pixels = pixels_in(k.camera);
    a.in(k.boards, boards);
    a.in(b.board.opaque_depth, pixels);
    a.both(b.board.transmittance, pixels);
    a.both(b.board.colour, 3 * pixels);
    a.both(b.board.half_depth, pixels);
    a.both(b.board.optical_depth, pixels);
    std::vector<ParticleTile> own;
    add_tiles(a, tiles, own, b.tiles);
    a.launch(device.kernels->board_tiles, k, b, 0, std::uint32_t(own.size()));
    return a.finish();
}

}  // namespace pileus
