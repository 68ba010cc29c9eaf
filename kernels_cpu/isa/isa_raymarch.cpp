// SPDX-License-Identifier: Apache-2.0
// Integrals along rays, and discrete ordinates that they read.
#include "kernels_cpu/ordinates/ordinates_march.h"
#include "kernels_cpu/ordinates/ordinates_sweep.h"
#define PILEUS_GROUP_Raymarch 1
#include "kernels_cpu/isa/kernel_group.h"
