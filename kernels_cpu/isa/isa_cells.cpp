// SPDX-License-Identifier: Apache-2.0
// Photons whose light a regular grid gathers; those of collectors pay nothing for them.
#include "kernels_cpu/photons/trace.h"
#define PILEUS_GROUP_Cells 1
#include "kernels_cpu/isa/kernel_group.h"
