// SPDX-License-Identifier: Apache-2.0
// A machine beside the processor with a memory of its own, as a table of functions.
// in: bytes, a kernel and its arguments -> out: false where it failed, and then `fault` says why.
// docs/crosscheck.md; platform/cuda_device.h is one, tests have another that lives on the host.
#pragma once
#include <cstdint>

namespace pileus {

struct Device {
    const char* name;
    /// Null when there is not so much memory.
    void* (*allocate)(std::uint64_t bytes);
    void (*release)(void* memory);
    bool (*upload)(void* to, const void* from, std::uint64_t bytes);
    bool (*download)(void* to, const void* from, std::uint64_t bytes);
    /// Calls kernel(params, buffers, begin, end) with a thread for each item from `begin` to `end`,
    /// and waits. `params` and `buffers` lie on the host; pointers inside are the device's.
    bool (*launch)(const void* kernel, const void* params, const void* buffers, std::uint32_t begin,
                   std::uint32_t end);
    /// What the last function that failed says about it.
    const char* (*fault)();
};

}  // namespace pileus
