// SPDX-License-Identifier: Apache-2.0
// Photons among media alone, and the packing of their sums.
#include "kernels_cpu/photons/pack_sums.h"
#include "kernels_cpu/photons/trace.h"
#define PILEUS_GROUP_Photons 1
#include "kernels_cpu/isa/kernel_group.h"
