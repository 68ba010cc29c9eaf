// SPDX-License-Identifier: Apache-2.0
// See device_launch.h. Which array is how long follows from the parameters of the launch.
// in: structs of one launch -> out: the same with the device's pointers; results copied back.
// docs/crosscheck.md
#include "src/run/device_launch.h"

#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/isa/device_threads.h"
#include "kernels_cpu/path/path_needs.h"
#include "src/run/device_views.h"

namespace pileus {
namespace {

using Size = DeviceSize;

/// Blocks that flights of the path tracer cross: a ring of one more around the grid.
Size product_with_ring(const std::int32_t (&n)[3]) {
    return (Size(n[0]) + 2) * (Size(n[1]) + 2) * (Size(n[2]) + 2);
}

void add_sampler(DeviceArrays& a, const SkyMapView& map, SkySampler& sampler) {
    const Size rows = Size(map.rows), columns = Size(map.columns);
    a.in(sampler.weight, rows * columns);
    a.in(sampler.row_cdf, rows);
    a.in(sampler.column_cdf, rows * columns);
}

/// As src/methods/path/trace_paths.cpp and src/photons/trace.cpp choose on the host.
const void* kernel_of(const DeviceKernels& kernels, const PathParams& k) {
    return needs_full(k) ? kernels.trace_paths_full : kernels.trace_paths;
}
const void* kernel_of(const DeviceKernels& kernels, const TraceParams& k) {
    if (k.cells[0] > 0) return kernels.trace_cells;
    return has_meshes(k.solids) ? kernels.trace_solids : kernels.trace;
}

}  // namespace

Status launch_on_device(const DeviceTable& device, const PathParams& params,
                        const PathBuffers& buffers, std::uint32_t count) {
    PathParams k = params;
    PathBuffers b = buffers;
    DeviceArrays a(*device.device);
    a.in(k.grid.density, product(k.grid.size));
    a.in(k.grid.majorant, product_with_ring(k.grid.blocks));
    for (int i = 0; i < k.media; ++i) a.in(k.optics[i].phase.table);
    a.in(k.parts, other_media(k.media, product(k.grid.size)));
    add_sky(a, k.map);
    add_sampler(a, k.map, k.sampler);
    add_heights(a, k.sun_heights);
    const void* const kernel = kernel_of(*device.kernels, k);
    add_solids(a, k.solids);
    add_paint(a, k.paint);
    a.in(k.camera_depth, pixels_in(k.camera));
    a.in(k.lamps, Size(k.lamp_count));
    a.both(b.radiance, b.stride * (k.parts_wanted != 0 ? 3 * kPathParts : 3));
    a.both(b.tally, 1);
    a.launch(kernel, k, b, 0, count);
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
    a.in(k.lamps, Size(k.lamp_count));
    a.in(k.emitted_below, product(k.grid.size));
    const void* const kernel = kernel_of(*device.kernels, k);
    add_solids(a, k.solids);
    a.in(b.collector, k.mode != kDepositNone ? product(k.grid.size) : 0);
    a.in(b.parts, other_media(k.media, product(k.grid.size)));
    const std::ptrdiff_t ground = b.ground - b.sums;
    a.both(b.sums, numbers);
    b.ground = b.sums != nullptr ? b.sums + ground : nullptr;
    a.both(b.tally, 1);
    a.launch(kernel, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const BlendParams& k,
                        const BlendBuffers& buffers, std::uint64_t spheres, std::uint32_t count) {
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
    const std::uint32_t step = items_at_once(count, blend_scratch_share(k));
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
