// SPDX-License-Identifier: Apache-2.0
// Whole launches on a device: arrays go there, one thread runs per item, arrays come back.
// in: the structs that kernels take on the host, and sizes they do not tell -> out: the same
// arrays. docs/crosscheck.md. Nothing stays on the device between two launches.
#pragma once
#include "kernels_cpu/isa/kernels.h"
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
Status launch_on_device(const DeviceTable& device, const PathParams& k, const PathBuffers& b,
                        std::uint32_t count);

/// `numbers`: of b.sums, those of the ground, which follow the collectors', among them.
Status launch_on_device(const DeviceTable& device, const TraceParams& k, const TraceBuffers& b,
                        std::uint64_t numbers, std::uint32_t count);

/// Of `count` tiles; `spheres`: of b.spheres. b.scratch is not used.
Status launch_on_device(const DeviceTable& device, const BlendParams& k, const BlendBuffers& b,
                        std::uint64_t spheres, std::uint32_t count);

/// The digest of the math kernels as the device computes it.
Status self_test_on_device(const DeviceTable& device, std::uint64_t& digest);

}  // namespace pileus
