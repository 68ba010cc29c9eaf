// SPDX-License-Identifier: Apache-2.0
// See emitters.h. A voxel's share is that of its density: of the trilinear field its weights add up
// to a voxel's volume, at the faces of the box, too.
// in: densities -> out: sums in the order of the voxels.
// docs/methods.md 3, "Shoot"
#include "src/world/medium/emitters.h"

#include "src/world/medium/medium.h"

namespace pileus {
namespace {

bool shines(const Optics& optics) {
    return optics.emission[0] > 0 || optics.emission[1] > 0 || optics.emission[2] > 0;
}

double density_of(const Medium& medium, int which, std::size_t voxel) {
    const std::size_t voxels = medium.volume.density.size();
    if (which > 0) return double(medium.parts[std::size_t(which - 1) * voxels + voxel]);
    double rest = double(medium.volume.density[voxel]);
    for (int i = 1; i < medium.count; ++i)
        rest -= double(medium.parts[std::size_t(i - 1) * voxels + voxel]);
    return rest > 0 ? rest : 0;
}

Status fill_table(const Medium& medium, Emitter& out) {
    const std::size_t voxels = medium.volume.density.size();
    double total = 0;
    for (std::size_t v = 0; v < voxels; ++v) total += density_of(medium, out.medium, v);
    out.mass_m3 = total;
    for (int a = 0; a < 3; ++a) out.mass_m3 *= double(medium.grid.cell_m[a]);
    if (!(total > 0)) return Status::ok();
    PILEUS_TRY(allocate(arrays::emitted_below(voxels), out.below));
    double sum = 0;
    for (std::size_t v = 0; v < voxels; ++v) {
        // Below 2^32 but where nothing comes behind: no number is drawn there.
        const double share = sum / total * 0x1p32;
        out.below[v] = share < 0x1p32 - 1 ? std::uint32_t(share) : 0xffffffffu;
        sum += density_of(medium, out.medium, v);
    }
    return Status::ok();
}

}  // namespace

Status make_emitters(Medium& medium) {
    medium.emitters.clear();
    if (!emits(medium) || !(medium.sigma > 0)) return Status::ok();
    double volume = 1;
    for (const double edge : medium.extent_m) volume *= edge;
    for (int i = 0; i < medium.count; ++i) {
        if (!shines(medium.optics[std::size_t(i)])) continue;
        Emitter emitter;
        emitter.medium = i;
        emitter.mass_m3 = volume;
        if (medium.volume.density.size() > 0) PILEUS_TRY(fill_table(medium, emitter));
        if (emitter.mass_m3 > 0) medium.emitters.push_back(std::move(emitter));
    }
    return Status::ok();
}

}  // namespace pileus
