// SPDX-License-Identifier: Apache-2.0
// See device.h.
// in: calls of the CUDA runtime -> out: false and its words where one fails.
// docs/crosscheck.md
#include "platform/device.h"

#if defined(PILEUS_WITH_CUDA)
#include <cuda_runtime_api.h>
#endif

namespace pileus {

#if defined(PILEUS_WITH_CUDA)
namespace {

constexpr unsigned kBlock = 128;  // threads that share a multiprocessor

void* allocate(std::uint64_t bytes) {
    void* memory = nullptr;
    return cudaMalloc(&memory, bytes) == cudaSuccess ? memory : nullptr;
}
void release(void* memory) { (void)cudaFree(memory); }
bool upload(void* to, const void* from, std::uint64_t bytes) {
    return cudaMemcpy(to, from, bytes, cudaMemcpyHostToDevice) == cudaSuccess;
}
bool download(void* to, const void* from, std::uint64_t bytes) {
    return cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost) == cudaSuccess;
}
bool launch(const void* kernel, const void* params, const void* buffers, std::uint32_t begin,
            std::uint32_t end) {
    if (begin >= end) return true;
    void* arguments[] = {const_cast<void*>(params), const_cast<void*>(buffers), &begin, &end};
    const dim3 grid((end - begin - 1) / kBlock + 1), block(kBlock);
    return cudaLaunchKernel(kernel, grid, block, arguments, 0, nullptr) == cudaSuccess &&
           cudaDeviceSynchronize() == cudaSuccess;
}
const char* fault() { return cudaGetErrorString(cudaGetLastError()); }

std::string version_text(int version) {
    return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

}  // namespace

const Device cuda_functions{"cuda", allocate, release, upload, download, launch, fault};

bool has_cuda_device(std::string& why) {
    int count = 0;
    const cudaError_t error = cudaGetDeviceCount(&count);
    if (error == cudaSuccess && count > 0) return true;
    why = std::string("no device (") +
          (error == cudaSuccess ? "none found" : cudaGetErrorString(error)) + ")";
    (void)cudaGetLastError();
    return false;
}

std::string cuda_device_text() {
    std::string ignored;
    cudaDeviceProp properties;
    int driver = 0, runtime = 0;
    if (!has_cuda_device(ignored) || cudaGetDeviceProperties(&properties, 0) != cudaSuccess ||
        cudaDriverGetVersion(&driver) != cudaSuccess ||
        cudaRuntimeGetVersion(&runtime) != cudaSuccess)
        return "";
    return std::string(properties.name) + ", compute " + std::to_string(properties.major) + "." +
           std::to_string(properties.minor) + ", driver " + version_text(driver) + ", runtime " +
           version_text(runtime);
}
#else
bool has_cuda_device(std::string& why) {
    why = "not built (cmake -DPILEUS_CUDA=ON)";
    return false;
}

std::string cuda_device_text() { return ""; }
#endif

}  // namespace pileus
