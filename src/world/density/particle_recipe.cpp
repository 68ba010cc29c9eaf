// SPDX-License-Identifier: Apache-2.0
// See particle_recipe.h.
#include "src/world/density/particle_recipe.h"

#include <algorithm>

#include "platform/threads.h"
#include "src/io/volumes/particle_volume.h"

namespace pileus {
namespace {

/// Cells of a default grid across the narrower side.
constexpr double kCellsAcross = 64;

}  // namespace

Status begin_recipe(const MediumSettings& medium, ParticleSet& out) {
    out = ParticleSet{};
    out.count = std::uint64_t(medium.particles.count);
    const std::uint64_t n = out.count;
    PILEUS_TRY(out.position.resize(3 * n, "particles"));
    PILEUS_TRY(out.radius.resize(n, "particles"));
    PILEUS_TRY(out.density.resize(n, "particles"));
    PILEUS_TRY(out.id.resize(n, "particles"));
    PILEUS_TRY(out.velocity.resize(3 * n, "particles"));
    for (std::uint64_t i = 0; i < n; ++i) out.id[i] = i;
    out.low = medium.box.bounds_m[0];
    out.high = medium.box.bounds_m[1];
    out.origin = out.low + (out.high - out.low) * 0.5;
    return Status::ok();
}

DensityOutline outline_recipe(const MediumSettings& medium, double mean) {
    DensityOutline outline;
    const Double3 extent = medium.box.bounds_m[1] - medium.box.bounds_m[0];
    const double width = std::min(extent[0], extent[1]);
    std::uint64_t cells = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        const double wanted = width > 0 ? kCellsAcross * extent[int(a)] / width : 1;
        const int own = wanted < 256 ? std::max(1, int(wanted + 0.5)) : 256;
        outline.size[a] = own;
        cells *= std::uint64_t(medium.box.resolution[0] > 0 ? medium.box.resolution[a] : own);
    }
    outline.mean = mean;
    // Places, radii, densities, numbers, velocities; sums of cells.
    outline.bytes = 40 * std::uint64_t(medium.particles.count) + 8 * cells;
    return outline;
}

Status lay_recipe(const MediumSettings& medium, const DensityMaking& with,
                  Status (*make)(const MediumSettings&, int, ParticleSet&), Volume& volume) {
    const int threads = with.threads > 0 ? with.threads : hardware_threads();
    ParticleSet set;
    PILEUS_TRY(make(medium, threads, set));
    PILEUS_TRY(grid_particles(set, with.size, threads, volume));
    volume.knows_bounds = volume.in_extinction = false;
    return Status::ok();
}

}  // namespace pileus
