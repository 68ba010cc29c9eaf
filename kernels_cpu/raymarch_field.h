// SPDX-License-Identifier: Apache-2.0
// What a raymarch marches through: the concept of a field, and the density grid as one.
// in: places in box-local metres, per lane -> out: densities, bounds ahead, shares of media.
// docs/raymarch.md, "Fields".
#pragma once
#include "kernels_cpu/march_ray.h"
#include "kernels_cpu/optics.h"

namespace pileus {
inline namespace PILEUS_ISA {

// A field is a struct of plain numbers and pointers with these functions beside it; places lie
// anywhere along a ray between where it enters and leaves.
//   field_clip(field, ray)                       where a ray enters and leaves the medium
//   field_holds(field, place)                    whether a place off the ray is within the medium
//   field_ahead(field, place, direction, width)  a bound on what field_density gives near the place
//                                                for steps of `width` metres, and metres until it
//                                                may change; bound 0: nothing up to there
//   field_density(field, place, width)           density, filtered for steps of `width` metres
//   field_shares(field, place, density, use)     use(i, share) for each medium; sum of shares 1

/// The trilinear density grid of the scene's media.
struct GridField {
    const MediumView* medium;
    const float* parts;  ///< [medium - 1][voxel]
    std::int32_t media;
};

template <class T>
PILEUS_FN Segment<T> field_clip(const GridField& f, const Ray<T>& ray) {
    return clip_to_medium(*f.medium, ray);
}

template <class T>
PILEUS_FN M_of<T> field_holds(const GridField& f, const Vec<T>& p) {
    const float* e = f.medium->extent;
    const auto height = (p.z >= 0.0f) & (p.z <= e[2]);
    if (f.medium->periodic != 0) return height;
    return height & (p.x >= 0.0f) & (p.x <= e[0]) & (p.y >= 0.0f) & (p.y <= e[1]);
}

template <class T>
PILEUS_FN Vec<T> field_voxels(const MediumView& m, const Vec<T>& place) {
    const Vec<T> q = reduced(m, place);
    return {q.x * (1.0f / m.cell[0]), q.y * (1.0f / m.cell[1]), q.z * (1.0f / m.cell[2])};
}

template <class T>
PILEUS_FN Block<T> field_ahead(const GridField& f, const Vec<T>& place, const Vec<T>& direction,
                               T) {
    return block_ahead(*f.medium, field_voxels(*f.medium, place), direction);
}

template <class T>
PILEUS_FN T field_density(const GridField& f, const Vec<T>& place, T) {
    const MediumView& m = *f.medium;
    return interpolate(m.density, corners(field_voxels(m, place), m.size, m.periodic != 0));
}

template <class T, class Use>
PILEUS_FN void field_shares(const GridField& f, const Vec<T>& place, T density, Use use) {
    if (f.media <= 1) return use(0, all<T>(1.0f));
    const MediumView& m = *f.medium;
    const Corners<T> at = corners(field_voxels(m, place), m.size, m.periodic != 0);
    for_shares(
        f.parts, std::int64_t(m.size[0]) * m.size[1] * m.size[2], f.media, density,
        [&](const float* grid) { return interpolate(grid, at); }, use);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
