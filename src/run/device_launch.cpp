// SPDX-License-Identifier: Apache-2.0
// See device_launch.h. Which array is how long follows from the parameters of the launch.
// in: structs of one launch -> out: the same with the device's pointers; results copied back.
// docs/crosscheck.md
#include "src/run/device_launch.h"

#include "kernels_cpu/isa/device_threads.h"
#include "src/run/device_arrays.h"

namespace pileus {
namespace {

using Size = std::uint64_t;

Size product(const std::int32_t (&n)[3]) { return Size(n[0]) * Size(n[1]) * Size(n[2]); }

/// Blocks that flights of the path tracer cross: a ring of one more around the grid.
Size product_with_ring(const std::int32_t (&n)[3]) {
    return (Size(n[0]) + 2) * (Size(n[1]) + 2) * (Size(n[2]) + 2);
}

Size pixels_of(const CameraParams& c) { return Size(c.width) * Size(c.height); }

template <class Grid>
void add_grid(DeviceArrays& a, Grid& grid) {
    a.in(grid.density, product(grid.size));
    a.in(grid.majorant, product(grid.blocks));
}

void add_sky(DeviceArrays& a, SkyMapView& map) {
    const Size rows = Size(map.rows), columns = Size(map.columns);
    a.in(map.radiance, Size(map.planes) * rows * columns);
    a.in(map.row_cdf, rows);
    a.in(map.column_cdf, rows * columns);
    a.in(map.row_bound, 2 * rows);
    a.in(map.column_bound, 2 * columns);
}

void add_sampler(DeviceArrays& a, const SkyMapView& map, SkySampler& sampler) {
    const Size rows = Size(map.rows), columns = Size(map.columns);
    a.in(sampler.weight, rows * columns);
    a.in(sampler.row_cdf, rows);
    a.in(sampler.column_cdf, rows * columns);
}

}  // namespace

Status launch_on_device(const DeviceTable& device, const ShadowParams& params,
                        const ShadowBuffers& buffers, std::uint32_t count) {
    ShadowParams k = params;
    ShadowBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_grid(a, k.medium);
    a.both(b.optical_depth, product(k.nodes.size));
    a.launch(device.kernels->shadow_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const MarchParams& params,
                        const MarchBuffers& buffers, std::uint32_t count) {
    MarchParams k = params;
    MarchBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_grid(a, k.medium);
    for (int i = 0; i < k.media; ++i) a.in(k.phase[i].table);
    const Size pixels = pixels_of(k.camera);
    const Size stored = Size(k.sets) * Size(k.harmonics);
    const Size numbers = k.bands > 0 && b.near == nullptr ? stored : Size(k.channels);
    a.in(b.near, Size(k.channels / 3) * stored * product(k.near.size));
    a.in(b.optical_depth, product(k.shadow.size));
    a.in(b.source, numbers * product(k.source.size));
    a.in(b.beam, Size(k.beam_sets) * Size(kBeamNumbers));
    a.in(b.opaque_depth, pixels);
    if (k.media > 1) a.in(b.parts, Size(k.media - 1) * product(k.medium.size));
    a.both(b.transmittance, pixels);
    a.both(b.half_depth, pixels);
    a.both(b.colour, Size(k.channels) * pixels);
    a.both(b.ray_depth, pixels);
    a.launch(device.kernels->march_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const BackgroundParams& params,
                        const BackgroundBuffers& buffers, std::uint32_t count) {
    BackgroundParams k = params;
    BackgroundBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_grid(a, k.medium);
    add_sky(a, k.sky_map);
    a.in(b.map, 3 * product(k.map.size));
    if (k.shadow.size[0] > 0) a.in(b.ground_depth, product(k.shadow.size));
    a.both(b.colour, 3 * pixels_of(k.camera));
    a.both(b.opaque_depth, pixels_of(k.camera));
    a.launch(device.kernels->background_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const PathParams& params,
                        const PathBuffers& buffers, std::uint32_t count) {
    PathParams k = params;
    PathBuffers b = buffers;
    DeviceArrays a(*device.device);
    a.in(k.grid.density, product(k.grid.size));
    a.in(k.grid.majorant, product_with_ring(k.grid.blocks));
    for (int i = 0; i < k.media; ++i) a.in(k.optics[i].phase.table);
    if (k.media > 1) a.in(k.parts, Size(k.media - 1) * product(k.grid.size));
    add_sky(a, k.map);
    add_sampler(a, k.map, k.sampler);
    a.both(b.radiance, b.stride * (k.parts_wanted != 0 ? 3 * kPathParts : 3));
    a.both(b.tally, 1);
    a.launch(seeks_sun(k) ? device.kernels->trace_paths_guided : device.kernels->trace_paths, k, b,
             0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const TraceParams& params,
                        const TraceBuffers& buffers, std::uint64_t numbers, std::uint32_t count) {
    TraceParams k = params;
    TraceBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_grid(a, k.grid);
    for (int i = 0; i < k.media; ++i) a.in(k.optics[i].phase.table);
    add_sky(a, k.map);
    if (k.mode != kDepositNone) a.in(b.collector, product(k.grid.size));
    if (k.media > 1) a.in(b.parts, Size(k.media - 1) * product(k.grid.size));
    const std::ptrdiff_t ground = b.ground - b.sums;
    a.both(b.sums, numbers);
    b.ground = b.sums != nullptr ? b.sums + ground : nullptr;
    a.both(b.tally, 1);
    a.launch(device.kernels->trace, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const BlendParams& k,
                        const BlendBuffers& buffers, std::uint64_t spheres, std::uint32_t count) {
    constexpr Size kMostScratch = Size{1} << 26;  // floats
    BlendBuffers b = buffers;
    DeviceArrays a(*device.device);
    const Size pixels = Size(k.width) * Size(k.height), channels = Size(k.channels);
    const Size listed = count > 0 ? buffers.tile_begin[count] : 0;
    a.in(b.spheres, spheres);
    a.in(b.sphere_colour, channels * k.colour_stride);
    a.in(b.tile_begin, Size(count) + 1);
    a.in(b.tile_spheres, listed);
    a.in(b.opaque_depth, pixels);
    a.both(b.transmittance, pixels);
    a.both(b.half_depth, pixels);
    a.both(b.colour, channels * pixels);
    // As many tiles at once as there is scratch for.
    const Size most = kMostScratch / blend_scratch_share(k);
    const std::uint32_t step = most < 1 ? 1 : (most < count ? std::uint32_t(most) : count);
    a.scratch(b.scratch, step * blend_scratch_share(k));
    for (std::uint32_t begin = 0; begin < count; begin += step)
        a.launch(device.kernels->blend_tile, k, b, begin,
                 count - begin < step ? count : begin + step);
    return a.finish();
}

Status self_test_on_device(const DeviceTable& device, std::uint64_t& digest) {
    digest = 0;
    SelfTestBuffers b{&digest};
    DeviceArrays a(*device.device);
    a.both(b.digest, 1);
    a.launch(device.kernels->self_test, NoParams{}, b, 0, 1);
    return a.finish();
}

}  // namespace pileus
