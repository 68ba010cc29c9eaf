// SPDX-License-Identifier: Apache-2.0
// What programs ask of method `optical-depth` besides pictures.
// in: nothing -> out: what its keys cannot say.
// docs/optical-depth.md
#include "src/methods/method_tools.h"
#include "src/methods/optical_depth/optical_depth.h"

namespace pileus {

const MethodTools optical_depth_tools{nullptr, nullptr, nullptr, nullptr, true};

}  // namespace pileus
