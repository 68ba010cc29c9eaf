// SPDX-License-Identifier: Apache-2.0
// The kernels as nvcc compiles them: the same sources with one lane, a thread per item.
// in: the launches' structs, their pointers the device's -> out: the same bits as on the host.
// docs/crosscheck.md; cmake/PileusCuda.cmake has the flags that keep the bits.
#include "kernels_cpu/display/air_rows.h"
#include "kernels_cpu/display/blend.h"
#include "kernels_cpu/display/march.h"
#include "kernels_cpu/display/march_background.h"
#include "kernels_cpu/display/upsample_rows.h"
#include "kernels_cpu/isa/device_threads.h"
#include "kernels_cpu/media/self_test.h"
#include "kernels_cpu/light/sweep_layer.h"
#include "kernels_cpu/light/sweep_turned.h"
#include "kernels_cpu/particles/particle_board.h"
#include "kernels_cpu/particles/particle_lamps.h"
#include "kernels_cpu/particles/particle_light.h"
#include "kernels_cpu/particles/particle_march.h"
#include "kernels_cpu/path/path.h"
#include "kernels_cpu/photons/trace.h"
#include "kernels_cpu/procedural/cumulus.h"
#include "kernels_cpu/procedural/sky_bake.h"
#include "kernels_cpu/procedural/sky_noise.h"
#include "kernels_cpu/raymarch/lamp_march.h"
#include "kernels_cpu/raymarch/raymarch.h"
#include "kernels_cpu/raymarch/raymarch_detail.h"
#include "kernels_cpu/raymarch/raymarch_sky.h"
#include "kernels_cpu/raymarch/sky_turn.h"
#include "kernels_cpu/solids/solid_rows.h"

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

#define PILEUS_CALL(name, Result, parameters, names, group, where)
#define PILEUS_RANGE(name, Params, Buffers, group, where) \
    PILEUS_ON_##where(PILEUS_DEVICE_KERNEL(name, Params, Buffers))
#include "kernels_cpu/isa/kernel_list.h"

__global__ void self_test_items(NoParams, SelfTestBuffers b, std::uint32_t begin, std::uint32_t) {
    if (begin + blockIdx.x * blockDim.x + threadIdx.x == begin) *b.digest = self_test<1>();
}

template <class Function>
constexpr const void* address(Function* function) {
    return (const void*)function;
}

}  // namespace

// Rows come in the order of the members, which are made from them, too.
const DeviceKernels cuda_kernels{
#define PILEUS_CALL(name, Result, parameters, names, group, where) \
    PILEUS_ON_##where(address(name##_items), )
#define PILEUS_RANGE(name, Params, Buffers, group, where) \
    PILEUS_ON_##where(address(name##_items), )
#include "kernels_cpu/isa/kernel_list.h"
};

}  // namespace pileus
