// SPDX-License-Identifier: Apache-2.0
// The path tracer among solids.
#include "kernels_cpu/path/path.h"
#define PILEUS_GROUP_PathSolids 1
#include "kernels_cpu/isa/kernel_group.h"
