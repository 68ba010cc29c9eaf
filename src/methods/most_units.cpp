// SPDX-License-Identifier: Apache-2.0
// See most_units.h.
#include "src/methods/most_units.h"

namespace pileus {

void most_pixels(const FrameWork& work, const std::array<int, 2>& size, bool opaque,
                 const UpsampleMemory& memory, FrameUnits& out) {
    const bool remembers = memory.ready && memory.camera.width == size[0] &&
                           memory.camera.height == size[1] &&
                           memory.opaque_depth.empty() == !opaque;
    const int temporal = remembers ? work.temporal : 1;
    const int every = work.temporal > 0 ? temporal : work.scale > 1 ? work.scale : 1;
    const auto thinned = [every](int n) {
        return std::uint64_t(n / every) + (n % every > 0 ? 1u : 0u);
    };
    out.pixels = std::uint64_t(size[0]) * std::uint64_t(size[1]);
    out.rays = thinned(size[0]) * thinned(size[1]);
}

Status most_grid_samples(const Medium& medium, std::uint64_t& samples) {
    const Grid& grid = medium.grid;
    if (grid.periodic)
        return Status::bad_input(
            "units: a periodic medium, in which a level ray has no end, allowed: boundary = "
            "\"open\"");
    double diagonal = 0;
    for (const double side : medium.extent_m) diagonal += side * side;
    // The first step and the last are parts of one; a ray has 8192 of them at the most.
    constexpr double kMax = 8192;
    const double steps = __builtin_sqrt(diagonal) / double(march_step(medium)) + 2;
    samples = std::uint64_t(steps < kMax ? steps : kMax);
    // Steps through constant cells end at their faces, too.
    if (grid.constant)
        for (const int n : grid.size) samples += std::uint64_t(n);
    return Status::ok();
}

Status add_lamp_samples(const Medium& medium, const Lighting& lighting, FrameUnits& out) {
    if (lighting.lamps.empty() && !emits(medium)) return Status::ok();
    std::uint64_t samples = 0;
    PILEUS_TRY(most_grid_samples(medium, samples));
    out.samples += out.pixels * samples;
    return Status::ok();
}

}  // namespace pileus
