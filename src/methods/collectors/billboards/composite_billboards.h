// SPDX-License-Identifier: Apache-2.0
// Shows spheres of constant extinction and colour as billboards, sorted and blended front to back.
// in: spheres in the box's metres, a camera, depths of solids -> out: planes of the media's light.
// docs/methods.md 3, each image frame, step 5; kernels_cpu/display/blend.h does the pixels.
#pragma once
#include <cstdint>

#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/display/blend_params.h"
#include "src/base/buffer.h"
#include "src/base/status.h"

namespace pileus {

/// `count` spheres. Centres and radii in metres (at most 1e15 in size), extinction in 1/m,
/// colour [channel][sphere]: radiance of an opaque sphere, any unit, 1 to 51 channels.
/// `opaque_depth` is [row][column], metres along the ray to a solid (infinity: none), or null.
struct DeviceTable;

struct BillboardScene {
    const float *x = nullptr, *y = nullptr, *z = nullptr;
    const float* radius = nullptr;
    const float* extinction = nullptr;
    const float* colour = nullptr;
    std::uint32_t count = 0;
    std::int32_t channels = 3;
    const float* opaque_depth = nullptr;
    bool half_depth = true;  ///< false: the picture's half_depth is left empty
};

/// Planes, rows from the top. `transmittance` in [0, 1]; `colour` [channel][row][column] is the
/// media's light alone, premultiplied; `half_depth` in metres along the ray, or infinity.
struct BillboardImage {
    std::int32_t width = 0, height = 0, channels = 0;
    Buffer<float> transmittance, colour, half_depth;
};

/// Pixels per tile; speed depends on it, results do not. Height 0: as many rows as fit the cache.
struct BillboardTiling {
    std::int32_t width = 256, height = 0;
};
/// Where a thread per tile blends, and there are thousands of threads.
constexpr BillboardTiling kDeviceTiling{32, 8};

/// kBadInput: a sphere, a number of channels or a camera out of range, the first fault named.
Status check_billboards(const BillboardScene& scene, const CameraParams& camera);

/// Blends all spheres. `threads` 0: all there are. `blend` is blend_tile at any width of lanes;
/// with a `device` it is not called, the device blends.
/// Buffers of `out` that already fit are used again. kBadInput: a sphere or camera out of range,
/// the first fault named; kLimit: no memory.
Status composite_billboards(const BillboardScene& scene, const CameraParams& camera, int threads,
                            BlendFunction blend, BillboardImage& out,
                            const BillboardTiling& tiling = {},
                            const DeviceTable* device = nullptr);

}  // namespace pileus
