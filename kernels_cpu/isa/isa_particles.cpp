// SPDX-License-Identifier: Apache-2.0
// The method particles.
#include "kernels_cpu/particles/particle_board.h"
#include "kernels_cpu/particles/particle_lamps.h"
#include "kernels_cpu/particles/particle_light.h"
#include "kernels_cpu/particles/particle_march.h"
#define PILEUS_GROUP_Particles 1
#include "kernels_cpu/isa/kernel_group.h"
