// SPDX-License-Identifier: Apache-2.0
// The path tracer lit by point, spot and parallel lights, and by media that emit.
#include "kernels_cpu/path/path.h"
#define PILEUS_GROUP_PathLamps 1
#include "kernels_cpu/isa/kernel_group.h"
