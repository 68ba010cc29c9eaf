// SPDX-License-Identifier: Apache-2.0
// A machine beside the processor with a memory of its own, as a table of functions.
// in: bytes, a kernel and its arguments -> out: false where it failed, and then `fault` says why.
// docs/crosscheck.md; NVIDIA's is one, tests have another that lives on the host.
#pragma once
#include <cstdint>
#include <string>

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

// NVIDIA's devices through the CUDA runtime, where the build has it (PILEUS_CUDA).

/// The first device, where this build has the runtime.
extern const Device cuda_functions;

/// Whether there is such a device; where not, `why` holds a phrase.
bool has_cuda_device(std::string& why);

/// "NVIDIA H200, compute 9.0, driver 13.0, runtime 13.0"; empty where there is none.
std::string cuda_device_text();

}  // namespace pileus
