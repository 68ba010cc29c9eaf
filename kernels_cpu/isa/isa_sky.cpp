// SPDX-License-Identifier: Apache-2.0
// Procedural densities.
#include "kernels_cpu/ordinates/ordinates_sky.h"
#include "kernels_cpu/procedural/cumulus.h"
#include "kernels_cpu/procedural/sky_bake.h"
#include "kernels_cpu/procedural/sky_noise.h"
#include "kernels_cpu/raymarch/raymarch_sky.h"
#define PILEUS_GROUP_Sky 1
#include "kernels_cpu/isa/kernel_group.h"
