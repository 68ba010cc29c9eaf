// SPDX-License-Identifier: Apache-2.0
// The kernels of a device: what it is asked to run, one for each of the kernel table.
// in: a build with a device's compiler -> out: addresses for Device::launch.
// docs/crosscheck.md; docs/architecture.md, "Kernels: written once".
#pragma once

namespace pileus {

struct Device;

/// Each runs one item (a photon, a row, a tile, a sample) per thread, with one lane.
struct DeviceKernels {
    const void *trace, *shadow_rows, *march_rows, *background_rows, *blend_tile, *trace_paths;
    const void* self_test;  ///< one item: SelfTestBuffers
    const void* trace_paths_guided;
};

/// A device and the kernels that it runs.
struct DeviceTable {
    const Device* device;
    const DeviceKernels* kernels;
};

/// Those of cuda_kernels.cu, where it is built.
extern const DeviceKernels cuda_kernels;

}  // namespace pileus
