// SPDX-License-Identifier: Apache-2.0
// See device_launch.h: procedural media.
// in: structs of one launch -> out: the same with the device's pointers; results copied back.
// docs/crosscheck.md
#include "src/run/device_launch.h"
#include "src/run/device_views.h"

namespace pileus {
namespace {

using Size = DeviceSize;

}  // namespace

Status launch_on_device(const DeviceTable& device, const NoiseParams& k,
                        const NoiseBuffers& buffers, std::uint32_t count) {
    NoiseBuffers b = buffers;
    DeviceArrays a(*device.device);
    a.both(b.values, Size(k.size) * Size(k.size) * Size(k.size));
    a.launch(device.kernels->noise_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const BakeParams& params,
                        const BakeBuffers& buffers, std::uint32_t count) {
    BakeParams k = params;
    BakeBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_layer(a, k.sky);
    a.both(b.density, product(k.size));
    a.launch(device.kernels->bake_sky_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const ColumnParams& params,
                        const ColumnBuffers& buffers, std::uint32_t count) {
    ColumnParams k = params;
    ColumnBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_layer(a, k.sky);
    a.both(b.most, count);
    a.launch(device.kernels->sky_columns, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const CumulusParams& params,
                        const CumulusBuffers& buffers, std::uint32_t count) {
    CumulusParams k = params;
    CumulusBuffers b = buffers;
    DeviceArrays a(*device.device);
    a.in(k.bubbles, Size(k.count));
    a.both(b.density, product(k.size));
    const std::uint32_t step = items_at_once(count, Size(kCumulusScratch));
    a.scratch(b.scratch, step * Size(kCumulusScratch));
    for (std::uint32_t begin = 0; begin < count; begin += step)
        a.launch(device.kernels->fill_cumulus, k, b, begin,
                 count - begin < step ? count : begin + step);
    return a.finish();
}

}  // namespace pileus
