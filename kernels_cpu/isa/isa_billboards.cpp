// SPDX-License-Identifier: Apache-2.0
// Blending of spheres, tile by tile.
#include "kernels_cpu/display/blend.h"
#define PILEUS_GROUP_Billboards 1
#include "kernels_cpu/isa/kernel_group.h"
