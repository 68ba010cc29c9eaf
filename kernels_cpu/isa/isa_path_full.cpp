// SPDX-License-Identifier: Apache-2.0
// The path tracer of every scene: lamps, media that emit, solids, paths guided to the sun, its
// disc.
#include "kernels_cpu/path/path.h"
#define PILEUS_GROUP_PathFull 1
#include "kernels_cpu/isa/kernel_group.h"
