// SPDX-License-Identifier: Apache-2.0
// The path tracer that is guided to the sun, and sees its disc.
#include "kernels_cpu/path/path.h"
#define PILEUS_GROUP_PathGuided 1
#include "kernels_cpu/isa/kernel_group.h"
