// SPDX-License-Identifier: Apache-2.0
// Marches through media with detail; those without pay nothing for it. docs/detail.md
// Clouds by type, whose octaves are detail, too. docs/generators.md
#include "kernels_cpu/ordinates/ordinates_detail.h"
#include "kernels_cpu/procedural/cloud_heap.h"
#include "kernels_cpu/procedural/cloud_layer.h"
#include "kernels_cpu/procedural/cloud_lens.h"
#include "kernels_cpu/procedural/cloud_rain.h"
#define PILEUS_GROUP_Detail 1
#include "kernels_cpu/isa/kernel_group.h"
