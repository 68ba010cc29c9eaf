// SPDX-License-Identifier: Apache-2.0
// A device that is none: memory of its own on the host, and threads in a shuffled order.
// in: the launches of src/run/device_launch.h -> out: what a device would do, by the scalar
// table. docs/crosscheck.md: the thread bodies are those of kernels_cpu/isa/cuda_kernels.cu.
#pragma once
#include <cstdlib>
#include <cstring>

#include "kernels_cpu/isa/device_threads.h"
#include "platform/device.h"
#include "platform/threads.h"

namespace device_test {

using namespace pileus;

constexpr std::uint64_t kGuard = 64;      // bytes before and behind each array
constexpr unsigned char kPattern = 0xA5;  // as floats -2.9e-16, as indices far out of range

/// Arrays as long as asked for, between guards; memory that nobody wrote holds the pattern.
inline void* allocate(std::uint64_t bytes) {
    auto* block = static_cast<unsigned char*>(std::malloc(std::size_t(bytes + 2 * kGuard)));
    if (block == nullptr) return nullptr;
    std::memset(block, kPattern, std::size_t(bytes + 2 * kGuard));
    std::memcpy(block, &bytes, sizeof bytes);
    return block + kGuard;
}
/// Ends the program where a kernel wrote past an array: no test could trust what follows.
inline void release(void* memory) {
    auto* block = static_cast<unsigned char*>(memory) - kGuard;
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, block, sizeof bytes);
    for (std::uint64_t i = sizeof bytes; i < kGuard; ++i)
        if (block[i] != kPattern || block[kGuard + bytes + i] != kPattern) std::abort();
    std::free(block);
}
inline bool copy(void* to, const void* from, std::uint64_t bytes) {
    std::memcpy(to, from, std::size_t(bytes));
    return true;
}
inline const char* fault() { return "made to fail"; }

using Launch = void (*)(const void* params, const void* buffers, std::uint32_t begin,
                        std::uint32_t end);

/// All items once, in an order far from ascending, on several threads of the host.
template <class Params, class Buffers, class Kernel>
void run_items(const void* params, const void* buffers, std::uint32_t begin, std::uint32_t end,
               Kernel kernel) {
    const auto& k = *static_cast<const Params*>(params);
    const auto& b = *static_cast<const Buffers*>(buffers);
    const std::uint64_t count = end - begin;
    // A step that has no factor in common with the count meets every item.
    std::uint64_t step = count / 3 * 2 + 1;
    const auto common = [](std::uint64_t x, std::uint64_t y) {
        while (y != 0) {
            const std::uint64_t rest = x % y;
            x = y, y = rest;
        }
        return x;
    };
    while (count > 0 && common(step, count) != 1) ++step;
    parallel_for(3, std::int64_t(count), [&](std::int64_t piece, int) {
        const std::uint64_t item = std::uint64_t(piece) * step % count;
        run_item(kernel, k, b, begin, begin + std::uint32_t(item));
    });
}

template <class Params, class Buffers,
          void (*KernelTable::*Kernel)(const Params&, const Buffers&, std::uint32_t, std::uint32_t)>
void emulate(const void* params, const void* buffers, std::uint32_t begin, std::uint32_t end) {
    run_items<Params, Buffers>(params, buffers, begin, end, kernel_table_at(0)->*Kernel);
}

inline void emulate_self_test(const void*, const void* buffers, std::uint32_t, std::uint32_t) {
    *static_cast<const SelfTestBuffers*>(buffers)->digest = kernel_table_at(0)->self_test();
}

inline bool launch(const void* kernel, const void* params, const void* buffers, std::uint32_t begin,
                   std::uint32_t end) {
    reinterpret_cast<Launch>(reinterpret_cast<std::uintptr_t>(kernel))(params, buffers, begin, end);
    return true;
}

inline const void* address(Launch function) {
    return reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(function));
}

/// Tables that live as long as this: hand `table` to RenderOptions::kernels.
struct Emulator {
    Device device{"emulated", allocate, release, copy, copy, launch, fault};
    DeviceKernels kernels;
    DeviceTable pair{&device, &kernels};
    KernelTable table{"emulated", 1, &pair};

    Emulator() {
#define PILEUS_CALL(name, Result, parameters, names, group, where) \
    PILEUS_ON_##where(kernels.name = address(emulate_##name);)
#define PILEUS_RANGE(name, Params, Buffers, group, where) \
    PILEUS_ON_##where(kernels.name = address(emulate<Params, Buffers, &KernelTable::name>);)
#include "kernels_cpu/isa/kernel_list.h"
    }
};

}  // namespace device_test
