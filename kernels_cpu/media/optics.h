// SPDX-License-Identifier: Apache-2.0
// What one medium does to light, and how several share one grid.
// in: albedos, phase functions, densities of the parts -> out: who scatters, and where to.
// docs/methods.md 2, "Several media": extinctions add, phases mix by their share.
#pragma once
#include "kernels_cpu/media/medium.h"
#include "kernels_cpu/media/phase.h"

namespace pileus {

/// Media that one scene may lay over one another.
constexpr int kMaxMedia = 8;

/// Of one medium. Unless told otherwise it is white and scatters alike in all directions.
struct Optics {
    float albedo[3] = {1, 1, 1};  ///< per channel; all the same when channels = 1
    float albedo_max = 1;         ///< survival probability of a collision
    PhaseParams phase;
    float emission[3] = {0, 0, 0};  ///< radiance per metre over extinction; read where media emit
};

inline namespace PILEUS_ISA {

/// Medium per lane at `voxel`, where `at` is uniform below the density. `parts` holds the densities
/// of media 1, 2 ...; what is left of the density belongs to medium 0.
template <class T>
PILEUS_FN auto medium_under(const float* parts, std::int64_t voxels, int media, I_of<T> voxel,
                            T at) {
    using II = I_of<T>;
    II medium{};
    T sum{};
    // Add in the order in which the density was summed: an absent medium is never drawn.
    for (int i = 1; i < media; ++i) {
        sum = sum + gather(parts + (i - 1) * voxels, voxel);
        medium = select((medium == 0) & (at < sum), all<II>(i), medium);
    }
    return medium;
}

/// Calls `use(i, share)` for every medium with its share of the `density`; `part(grid)` reads the
/// density of a part where it is wanted. The shares add up to 1.
template <class T, class Part, class Use>
PILEUS_FN void for_shares(const float* parts, std::int64_t voxels, int media, T density, Part part,
                          Use use) {
    const T unit = 1.0f / max_(density, all<T>(1e-30f));
    T rest = all<T>(1.0f);
    for (int i = 1; i < media; ++i) {
        const T share = min_(part(parts + (i - 1) * voxels) * unit, rest);
        rest = rest - share;
        use(i, share);
    }
    use(0, rest);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
