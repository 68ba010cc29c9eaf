// SPDX-License-Identifier: Apache-2.0
// Photons among solids; those without pay nothing for them.
#include "kernels_cpu/photons/trace.h"
#define PILEUS_GROUP_PhotonSolids 1
#include "kernels_cpu/isa/kernel_group.h"
