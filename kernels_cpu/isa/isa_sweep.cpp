// SPDX-License-Identifier: Apache-2.0
// The sun's optical depth by slices, and the turning of skylight.
#include "kernels_cpu/light/sweep_layer.h"
#include "kernels_cpu/light/sweep_turned.h"
#include "kernels_cpu/raymarch/sky_turn.h"
#define PILEUS_GROUP_Sweep 1
#include "kernels_cpu/isa/kernel_group.h"
