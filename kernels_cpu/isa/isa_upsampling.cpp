// SPDX-License-Identifier: Apache-2.0
// Pixels between marched ones.
#include "kernels_cpu/display/finish_rows.h"
#include "kernels_cpu/display/upsample_rows.h"
#define PILEUS_GROUP_Upsampling 1
#include "kernels_cpu/isa/kernel_group.h"
