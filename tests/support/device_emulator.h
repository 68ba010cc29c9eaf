// SPDX-License-Identifier: Apache-2.0
// A device that is none: memory of its own on the host, and threads in a shuffled order.
// in: the launches of src/run/device_launch.h -> out: what a device would do, by the scalar
// table. docs/crosscheck.md: the thread bodies are those of kernels_cpu/isa/cuda_kernels.cu.
#pragma once
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <mutex>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "kernels_cpu/isa/device_threads.h"
#include "platform/device.h"
#include "platform/threads.h"

namespace device_test {

using namespace pileus;

constexpr std::uint64_t kGuard = 64;      // bytes before and behind each array
constexpr unsigned char kPattern = 0xA5;  // as floats -2.9e-16, as indices far out of range

/// What lies in the device's memory.
class Blocks {
public:
    void add(const void* memory, std::uint64_t bytes) {
        const std::lock_guard<std::mutex> lock(mutex_);
        ends_[std::uintptr_t(memory)] = std::uintptr_t(memory) + bytes;
    }
    void remove(const void* memory) {
        const std::lock_guard<std::mutex> lock(mutex_);
        ends_.erase(std::uintptr_t(memory));
    }
    /// Ends the program where a struct holds an address of the host: a device could not read it.
    void check(const void* from, std::size_t bytes) {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (std::size_t at = 0; at + sizeof(void*) <= bytes; at += sizeof(void*)) {
            std::uintptr_t word = 0;
            std::memcpy(&word, static_cast<const char*>(from) + at, sizeof word);
            // A small number beside padding, where an older address has left its upper half.
            if ((word & 0xffffffffu) < 4096 || word % 4 != 0) continue;
            if (!is_memory(word)) continue;
            const auto next = ends_.upper_bound(word);
            if (next != ends_.begin() && word <= std::prev(next)->second) continue;
            std::fprintf(stderr, "a launch was given the host's address %zx at byte %zu of %zu\n",
                         std::size_t(word), at, bytes);
            std::abort();
        }
    }

private:
    static bool is_memory(std::uintptr_t word) {
#if defined(__linux__)
        return word >= kPage &&
               msync(reinterpret_cast<void*>(word / kPage * kPage), 1, MS_ASYNC) == 0;
#else
        return (void)word, false;
#endif
    }
    static constexpr std::uintptr_t kPage = 4096;

    std::mutex mutex_;
    std::map<std::uintptr_t, std::uintptr_t> ends_;
};
inline Blocks& blocks() {
    static Blocks all;
    return all;
}

/// Arrays as long as asked for, between guards; memory that nobody wrote holds the pattern.
inline void* allocate(std::uint64_t bytes) {
    auto* block = static_cast<unsigned char*>(std::malloc(std::size_t(bytes + 2 * kGuard)));
    if (block == nullptr) return nullptr;
    std::memset(block, kPattern, std::size_t(bytes + 2 * kGuard));
    std::memcpy(block, &bytes, sizeof bytes);
    blocks().add(block + kGuard, bytes);
    return block + kGuard;
}
/// Ends the program where a kernel wrote past an array: no test could trust what follows.
inline void release(void* memory) {
    auto* block = static_cast<unsigned char*>(memory) - kGuard;
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, block, sizeof bytes);
    for (std::uint64_t i = sizeof bytes; i < kGuard; ++i)
        if (block[i] != kPattern || block[kGuard + bytes + i] != kPattern) std::abort();
    blocks().remove(memory);
    std::free(block);
}
inline bool copy(void* to, const void* from, std::uint64_t bytes) {
    std::memcpy(to, from, std::size_t(bytes));
    return true;
}
inline const char* fault() { return "made to fail"; }

using Launch = void (*)(const void* params, const void* buffers, std::uint32_t begin,
                        std::uint32_t end);

constexpr std::uint64_t kBlock = 128;  // threads, as platform/cuda_device.cpp has them

/// A step that has no factor in common with the count, and so meets every one of them.
inline std::uint64_t step_through(std::uint64_t count) {
    const auto common = [](std::uint64_t x, std::uint64_t y) {
        while (y != 0) {
            const std::uint64_t rest = x % y;
            x = y, y = rest;
        }
        return x;
    };
    std::uint64_t step = count / 3 * 2 + 1;
    while (count > 0 && common(step, count) != 1) ++step;
    return step;
}

/// Whole blocks of threads, the last one's beyond the end too, in an order far from ascending: of
/// the blocks, and of the threads in each. Several threads of the host take them.
template <class Params, class Buffers, class Kernel>
void run_items(const void* params, const void* buffers, std::uint32_t begin, std::uint32_t end,
               Kernel kernel) {
    const auto& k = *static_cast<const Params*>(params);
    const auto& b = *static_cast<const Buffers*>(buffers);
    if (begin >= end) return;
    blocks().check(params, sizeof k);
    blocks().check(buffers, sizeof b);
    const std::uint64_t block_count = (end - begin - 1) / kBlock + 1;
    const std::uint64_t block_step = step_through(block_count), thread_step = step_through(kBlock);
    parallel_for(3, std::int64_t(block_count * kBlock), [&](std::int64_t piece, int) {
        const std::uint64_t block = std::uint64_t(piece) / kBlock * block_step % block_count;
        const std::uint64_t thread = std::uint64_t(piece) * thread_step % kBlock;
        const std::uint64_t item = begin + block * kBlock + thread;
        if (item < end) run_item(kernel, k, b, begin, std::uint32_t(item));
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
