// SPDX-License-Identifier: Apache-2.0
// Where launches go: a flight, which has no device, is compiled with a header in place of this.
// in: the device of a table of kernels -> out: whether there is one. docs/flight.md, "Build"
#pragma once
#include "kernels_cpu/isa/kernels.h"

namespace pileus {

inline bool on_device(const DeviceTable* device) { return device != nullptr; }

}  // namespace pileus
