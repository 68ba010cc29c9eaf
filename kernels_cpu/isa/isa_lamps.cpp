// SPDX-License-Identifier: Apache-2.0
// The march of light from lamps.
#include "kernels_cpu/raymarch/lamp_march.h"
#define PILEUS_GROUP_Lamps 1
#include "kernels_cpu/isa/kernel_group.h"
