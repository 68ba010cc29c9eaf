// SPDX-License-Identifier: Apache-2.0
// The march of a medium's collected light.
#include "kernels_cpu/display/march.h"
#define PILEUS_GROUP_March 1
#include "kernels_cpu/isa/kernel_group.h"
