// SPDX-License-Identifier: Apache-2.0
// The path tracer that splits particles by importance.
#include "kernels_cpu/path/importance.h"
#define PILEUS_GROUP_PathImportance 1
#include "kernels_cpu/isa/kernel_group.h"
