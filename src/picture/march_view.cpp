// SPDX-License-Identifier: Apache-2.0
// See march_view.h.
#include "src/picture/march_view.h"

#include <limits>

#include "src/picture/background.h"
#include "src/world/majorant/majorant.h"

namespace pileus {

MediumView make_medium_view(const Medium& medium, const Majorants& majorants) {
    MediumView v{};
    v.step = march_step(medium);
    for (int a = 0; a < 3; ++a) {
        v.size[a] = medium.grid.size[a];
        v.cell[a] = medium.grid.cell_m[a];
        v.extent[a] = float(medium.extent_m[a]);
    }
    block_counts(medium.grid, majorants.skip_block, v.blocks);
    v.block = float(majorants.skip_block);
    v.sigma = medium.sigma;
    v.density = medium.volume.density.data();
    v.majorant = majorants.skipping.data();
    v.periodic = medium.grid.periodic ? 1 : 0;
    v.constant = medium.grid.constant ? 1 : 0;
    v.detail = medium.detail.present() ? &medium.detail.view : nullptr;
    return v;
}

MarchKernel march_kernel(const KernelTable& kernels, const MediumView& medium) {
    return medium.detail != nullptr ? kernels.detail_march_rows : kernels.march_rows;
}

ShadowKernel shadow_kernel(const KernelTable& kernels, const MediumView& medium) {
    return medium.detail != nullptr ? kernels.detail_shadow_rows : kernels.shadow_rows;
}

Status march_medium(const Context& context, const Medium& medium, const Majorants& majorants,
                    const Lighting& lighting, const CameraParams& camera, const MarchWanted& wanted,
                    Planes& planes) {
    const StageClock clock(context, "alpha");
    const std::uint32_t rows = std::uint32_t(camera.height);
    const std::uint64_t pixels = std::uint64_t(camera.width) * rows;
    if (wanted.optical_depth)
        PILEUS_TRY(allocate(arrays::picture_planes(1, pixels), planes.optical_depth));
    if (lighting.opaque()) {
        BackgroundParams k{};
        k.medium = make_medium_view(medium, majorants);
        k.camera = camera;
        k.ground = lighting.ground.present ? 1 : 0;
        k.ground_z = float(lighting.ground.z);
        const BackgroundBuffers b{nullptr, nullptr, planes.opaque_depth.data()};
        PILEUS_TRY(show_background(context, lighting, k, b));
    }
    // No planes of colour: the kernel's light is left out, its steps stay.
    MarchParams k{};
    k.medium = make_medium_view(medium, majorants);
    k.camera = camera;
    k.lattice = whole_lattice(camera);
    for (int a = 0; a < 3; ++a) k.source.size[a] = k.shadow.size[a] = 1;
    // No picture shows less; whoever asks for the depth gets all of it.
    if (!wanted.optical_depth) k.cut = std::numeric_limits<float>::min();
    MarchBuffers b{};
    b.opaque_depth = planes.opaque_depth.data();
    b.transmittance = planes.transmittance.data();
    b.half_depth = wanted.half_depth ? planes.half_depth.data() : nullptr;
    b.ray_depth = planes.optical_depth.data();
    PILEUS_TRY(run_rows(context, march_kernel(*context.kernels, k.medium), k, b, rows));
    return Status::ok();
}

}  // namespace pileus
