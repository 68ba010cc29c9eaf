// SPDX-License-Identifier: Apache-2.0
// The table of kernels: one per instruction set, all giving the same bits.
// in: a name or nothing -> out: the functions of kernel_list.h; threads live in the caller.
// docs/architecture.md, "Kernels: written once".
#pragma once
#include "kernels_cpu/display/air_params.h"
#include "kernels_cpu/display/blend_params.h"
#include "kernels_cpu/display/finish_params.h"
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/display/pixel_params.h"
#include "kernels_cpu/display/upsample_params.h"
#include "kernels_cpu/light/sweep_params.h"
#include "kernels_cpu/ordinates/ordinates_params.h"
#include "kernels_cpu/ordinates/ordinates_sky_params.h"
#include "kernels_cpu/particles/particle_board_params.h"
#include "kernels_cpu/particles/particle_params.h"
#include "kernels_cpu/path/path_params.h"
#include "kernels_cpu/photons/pack_params.h"
#include "kernels_cpu/photons/trace_params.h"
#include "kernels_cpu/procedural/cloud_params.h"
#include "kernels_cpu/procedural/sky_params.h"
#include "kernels_cpu/raymarch/lamp_march_params.h"
#include "kernels_cpu/raymarch/raymarch_params.h"
#include "kernels_cpu/raymarch/raymarch_sky_params.h"
#include "kernels_cpu/raymarch/sky_turn_params.h"
#include "kernels_cpu/solids/solids_params.h"

namespace pileus {

struct Device;

// The code of rows that a device has.
#define PILEUS_ON_Device(...) __VA_ARGS__
#define PILEUS_ON_Host(...)

/// What a device is asked to run, addresses for Device::launch: one item (a photon, a row, a tile,
/// a sample) per thread, with one lane. `self_test` has one item, SelfTestBuffers.
struct DeviceKernels {
#define PILEUS_CALL(name, Result, parameters, names, group, where) \
    PILEUS_ON_##where(const void* name = nullptr;)
#define PILEUS_RANGE(name, Params, Buffers, group, where) \
    PILEUS_ON_##where(const void* name = nullptr;)
#include "kernels_cpu/isa/kernel_list.h"
};

/// A device and the kernels that it runs.
struct DeviceTable {
    const Device* device;
    const DeviceKernels* kernels;
};

/// Those of cuda_kernels.cu, where it is built.
extern const DeviceKernels cuda_kernels;

/// Null: a kernel that this library was built without, or that the host runs for a device. What
/// would launch it is refused before.
struct KernelTable {
    const char* name;
    int width;
    /// Where set, the functions below are not called: whole launches go to the device.
    const DeviceTable* device = nullptr;
#define PILEUS_CALL(name, Result, parameters, names, group, where) \
    Result(*name) parameters = nullptr;
#define PILEUS_RANGE(name, Params, Buffers, group, where)                                     \
    void (*name)(const Params& k, const Buffers& b, std::uint32_t begin, std::uint32_t end) = \
        nullptr;
#include "kernels_cpu/isa/kernel_list.h"
};

/// The widest table this machine runs; `name` (or null) forces one. Null: no such table here.
const KernelTable* kernel_table(const char* name);

/// Kernels of what stays on the host whatever draws: those of `table`, or the host's widest
/// where that is null or a device's.
inline const KernelTable& host_kernels(const KernelTable* table) {
    return table != nullptr && table->device == nullptr ? *table : *kernel_table(nullptr);
}

/// Those of `table`, or the host's widest where that is null.
inline const KernelTable& kernels_of(const KernelTable* table) {
    return table != nullptr ? *table : *kernel_table(nullptr);
}

/// Table number i of those compiled in and runnable here, narrowest first; null past the end.
const KernelTable* kernel_table_at(int i);

/// What self_test must give.
std::uint64_t expected_self_test();

}  // namespace pileus
