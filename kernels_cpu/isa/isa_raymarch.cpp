// SPDX-License-Identifier: Apache-2.0
// Integrals along rays.
#include "kernels_cpu/raymarch/raymarch.h"
#define PILEUS_GROUP_Raymarch 1
#include "kernels_cpu/isa/kernel_group.h"
