// SPDX-License-Identifier: Apache-2.0
// The medium along the rays through pixel centres, without light: what alpha and depth show.
// in: a medium, its blocks to skip, a camera -> out: transmittance, optical and half depth.
// docs/formats.md, "Pictures out".
#pragma once
#include "src/picture/layers.h"
#include "src/run/context.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

/// The grid as the marching kernels see it; `majorants` holds the blocks to skip.
MediumView make_medium_view(const Medium& medium, const Majorants& majorants);

/// The kernels that march through a medium: those with detail where it has some.
using MarchKernel = decltype(KernelTable::march_rows);
MarchKernel march_kernel(const KernelTable& kernels, const MediumView& medium);
using ShadowKernel = decltype(KernelTable::shadow_rows);
ShadowKernel shadow_kernel(const KernelTable& kernels, const MediumView& medium);

/// Which of its results a march stores; transmittance always.
struct MarchWanted {
    bool half_depth = false, optical_depth = false;
};

/// Marches the whole way of each ray in the box, or to the ground, without a cut, into the planes'
/// `transmittance` and what is wanted; `opaque_depth` where there is a ground or something solid.
/// Needs the planes' sizes as allocate_planes leaves them. kLimit: out of memory.
Status march_medium(const Context& context, const Medium& medium, const Majorants& majorants,
                    const Lighting& lighting, const CameraParams& camera, const MarchWanted& wanted,
                    Planes& planes);

}  // namespace pileus
