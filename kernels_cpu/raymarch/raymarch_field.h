// SPDX-License-Identifier: Apache-2.0
// What a raymarch marches through: the concept of a field, and the density grid as one.
// in: places in box-local metres, per lane -> out: densities, bounds ahead, shares of media.
// docs/raymarch.md, "Fields".
#pragma once
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/media/optics.h"

namespace pileus {
inline namespace PILEUS_ISA {

// A field is a struct of plain numbers and pointers with these functions beside it; places lie
// anywhere along a ray between where it enters and leaves.
//   field_clip(field, ray)                       where a ray enters and leaves the medium
//   field_holds(field, place)                    whether a place off the ray is within the medium
//   field_ahead(field, place, direction, width)  a bound on what field_density gives near the place
//                                                for steps of `width` metres, and metres until it
//                                                may change; bound 0: nothing up to there
//   field_in_box(field, medium, place)            where nodes over the medium's box are read
//   Field::kBoundsAreCheap                       whether to ask for a bound before each density
//   Field::kHasVoxels                            whether densities are constant within voxels; then
//   field_voxel(field, place, direction, least)  metres to the end of the voxel, at least `least`
//   Field::kHasSunNodes                          whether `field.light` may be nodes of sunlight;
//   then field_sun_depth(field, place)                what they hold of the optical depth to the
//   sun field_density(field, place, width)           density, filtered for steps of `width` metres
//   field_shares(field, place, density, use)     use(i, share) for each medium; sum of shares 1

/// The density grid of the scene's media, and coarser ones of the same box: trilinear, or with one
/// density for each voxel.
template <bool Constant>
struct GridField {
    static constexpr bool kBoundsAreCheap = true, kHasVoxels = Constant, kHasSunNodes = false;
    const MediumView* medium;
    const MediumView* level;  ///< [levels], the finest first
    std::int32_t levels;
    const float* parts;  ///< [medium - 1][voxel]
    std::int32_t media;
};

template <bool Constant, class T>
PILEUS_FN Segment<T> field_clip(const GridField<Constant>& f, const Ray<T>& ray) {
    return clip_to_medium(*f.medium, ray);
}

template <bool Constant, class T>
PILEUS_FN M_of<T> field_holds(const GridField<Constant>& f, const Vec<T>& p) {
    const float* e = f.medium->extent;
    const auto height = (p.z >= 0.0f) & (p.z <= e[2]);
    if (f.medium->periodic != 0) return height;
    return height & (p.x >= 0.0f) & (p.x <= e[0]) & (p.y >= 0.0f) & (p.y <= e[1]);
}

/// The place in the medium's box that nodes over it hold for a place.
template <class T, class Field>
PILEUS_FN Vec<T> field_in_box(const Field&, const MediumView& m, const Vec<T>& place) {
    return reduced(m, place);
}

template <class T>
PILEUS_FN Vec<T> grid_voxels(const MediumView& m, const Vec<T>& place) {
    return in_voxels(m, reduced(m, place));
}
template <bool Constant, class T>
PILEUS_FN T grid_density(const MediumView& m, const Vec<T>& place) {
    return read_density<Constant>(m.density, density_corners<Constant>(m, grid_voxels(m, place)));
}

/// Mixed levels have no voxels: nothing ends.
template <class T>
PILEUS_FN T field_voxel(const GridField<true>& f, const Vec<T>& place, const Vec<T>& direction,
                        T least) {
    if (f.levels > 0) return all<T>(3.0e38f);
    return voxel_ahead(*f.medium, grid_voxels(*f.medium, place), direction, least);
}

/// Level whose cells are as long as a step: a finer one holds waves that the steps do not follow.
template <bool Constant, class T>
PILEUS_FN T grid_level(const GridField<Constant>& f, T width) {
    const T cells = max_(width * (1.0f / f.medium->step), all<T>(1.0f));
    return min_(log_(cells) * 1.44269504f, all<T>(float(f.levels)));
}

/// Empty cells of a level have none but empty ones below them, with their borders.
template <bool Constant, class T>
PILEUS_FN Block<T> field_ahead(const GridField<Constant>& f, const Vec<T>& place,
                               const Vec<T>& direction, T width) {
    if (f.levels == 0) return block_ahead(*f.medium, grid_voxels(*f.medium, place), direction);
    const T level = grid_level(f, width);
    const auto whole = to_int(level);
    const auto upper = select(to_float(whole) < level, whole + 1, whole);
    Block<T> out{};
    for (std::int32_t l = 0; l <= f.levels; ++l) {
        const auto here = upper == l;
        if (!any(here)) continue;
        const MediumView& m = l == 0 ? *f.medium : f.level[l - 1];
        const Block<T> b = block_ahead(m, grid_voxels(m, place), direction);
        out.bound = select(here, b.bound, out.bound);
        out.rest = select(here, b.rest, out.rest);
    }
    return out;
}

template <bool Constant, class T>
PILEUS_FN T field_density(const GridField<Constant>& f, const Vec<T>& place, T width) {
    if (f.levels == 0) return grid_density<Constant>(*f.medium, place);
    const T level = grid_level(f, width);
    T out{};
    for (std::int32_t l = 0; l <= f.levels; ++l) {
        // Linear between the two levels beside it.
        const T weight = max_(1.0f - abs_(level - float(l)), T{});
        const auto here = weight > 0.0f;
        if (!any(here)) continue;
        const T density = grid_density<Constant>(l == 0 ? *f.medium : f.level[l - 1], place);
        out = out + select(here, weight * density, T{});
    }
    return out;
}

template <bool Constant, class T, class Use>
PILEUS_FN void field_shares(const GridField<Constant>& f, const Vec<T>& place, T density, Use use) {
    if (f.media <= 1) return use(0, all<T>(1.0f));
    const MediumView& m = *f.medium;
    const Corners<T> at = density_corners<Constant>(m, grid_voxels(m, place));
    // Parts have no levels: their shares are those of the grid itself.
    if (f.levels > 0) density = read_density<Constant>(m.density, at);
    for_shares(
        f.parts, std::int64_t(m.size[0]) * m.size[1] * m.size[2], f.media, density,
        [&](const float* grid) { return read_density<Constant>(grid, at); }, use);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
