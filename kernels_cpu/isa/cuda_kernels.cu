// SPDX-License-Identifier: Apache-2.0
// The kernels as nvcc compiles them: the same sources with one lane, a thread per item.
// in: the launches' structs, their pointers the device's -> out: the same bits as on the host.
// docs/crosscheck.md; cmake/PileusCuda.cmake has the flags that keep the bits.
#include "kernels_cpu/display/blend.h"
#include "kernels_cpu/isa/device_kernels.h"
#include "kernels_cpu/isa/device_threads.h"
#include "kernels_cpu/display/march.h"
#include "kernels_cpu/display/march_background.h"
#include "kernels_cpu/path/path.h"
#include "kernels_cpu/isa/self_test.h"
#include "kernels_cpu/photons/trace.h"

namespace pileus {
namespace {

// The name of a template cannot be handed over as a kernel: wrap each in a type.
#define PILEUS_DEVICE_KERNEL(name, Params, Buffers)                                            \
    struct name##_one_lane {                                                                   \
        __device__ __forceinline__ void operator()(const Params& k, const Buffers& b,         \
                                                   std::uint32_t begin,                        \
                                   std::uint32_t end) const {                                  \
            name<1>(k, b, begin, end);                                                         \
        }                                                                                      \
    };                                                                                         \
    __global__ void name##_items(const __grid_constant__ Params k,                             \
                                 const __grid_constant__ Buffers b, std::uint32_t begin,       \
                                 std::uint32_t end) {                                          \
        const std::uint32_t item = begin + blockIdx.x * blockDim.x + threadIdx.x;              \
        if (item >= begin && item < end) run_item(name##_one_lane{}, k, b, begin, item);       \
    }

PILEUS_DEVICE_KERNEL(trace, TraceParams, TraceBuffers)
PILEUS_DEVICE_KERNEL(shadow_rows, ShadowParams, ShadowBuffers)
PILEUS_DEVICE_KERNEL(march_rows, MarchParams, MarchBuffers)
PILEUS_DEVICE_KERNEL(background_rows, BackgroundParams, BackgroundBuffers)
PILEUS_DEVICE_KERNEL(blend_tile, BlendParams, BlendBuffers)
PILEUS_DEVICE_KERNEL(trace_paths, PathParams, PathBuffers)
// Of the two forms of trace_paths_guided the one without solids, which devices know not.
template <int W>
__device__ __forceinline__ void trace_paths_seeking(const PathParams& k, const PathBuffers& b,
                                                    std::uint32_t begin, std::uint32_t end) {
    trace_paths<W, kSeekingSun>(k, b, begin, end);
}
PILEUS_DEVICE_KERNEL(trace_paths_seeking, PathParams, PathBuffers)

__global__ void self_test_item(NoParams, SelfTestBuffers b, std::uint32_t begin, std::uint32_t) {
    if (begin + blockIdx.x * blockDim.x + threadIdx.x == begin) *b.digest = self_test_digest<1>();
}

template <class Function>
constexpr const void* address(Function* function) {
    return (const void*)function;
}

}  // namespace

const DeviceKernels cuda_kernels{
    address(trace_items),       address(shadow_rows_items), address(march_rows_items),
    address(background_rows_items), address(blend_tile_items),  address(trace_paths_items),
    address(self_test_item),    address(trace_paths_seeking_items)};

}  // namespace pileus
