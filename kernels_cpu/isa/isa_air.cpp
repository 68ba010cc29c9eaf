// SPDX-License-Identifier: Apache-2.0
// The air in front of pictures.
#include "kernels_cpu/display/air_rows.h"
#define PILEUS_GROUP_Air 1
#include "kernels_cpu/isa/kernel_group.h"
