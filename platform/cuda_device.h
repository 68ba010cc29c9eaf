// SPDX-License-Identifier: Apache-2.0
// NVIDIA's devices through the CUDA runtime, where the build has it (PILEUS_CUDA).
// in: nothing -> out: the first device, or why there is none.
// docs/crosscheck.md
#pragma once
#include <string>

#include "platform/device.h"

namespace pileus {

/// The first device, where this build has the runtime.
extern const Device cuda_functions;

/// Whether there is such a device; where not, `why` holds a phrase.
bool has_cuda_device(std::string& why);

/// "NVIDIA H200, compute 9.0, driver 13.0, runtime 13.0"; empty where there is none.
std::string cuda_device_text();

}  // namespace pileus
