// SPDX-License-Identifier: Apache-2.0
// Rays against solid meshes.
#include "kernels_cpu/solids/solid_rows.h"
#define PILEUS_GROUP_Solids 1
#include "kernels_cpu/isa/kernel_group.h"
