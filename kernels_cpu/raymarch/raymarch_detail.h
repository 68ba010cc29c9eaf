// SPDX-License-Identifier: Apache-2.0
// Marches through the density grid with detail, which is made on the way.
// in: a grid, a tile of noise -> out: its kernels; as a field what raymarch_field.h asks for.
// docs/detail.md
#pragma once
#include "kernels_cpu/display/march.h"
#include "kernels_cpu/raymarch/raymarch.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The factor makes nothing out of empty cells, so that the grid's bounds still tell where there is
/// none; no one reads how large they are.
struct DetailField {
    static constexpr bool kBoundsAreCheap = true, kHasVoxels = false, kHasSunNodes = false;
    GridField<false> grid;
};

template <class T>
PILEUS_FN Segment<T> field_clip(const DetailField& f, const Ray<T>& ray) {
    return field_clip(f.grid, ray);
}
template <class T>
PILEUS_FN M_of<T> field_holds(const DetailField& f, const Vec<T>& p) {
    return field_holds(f.grid, p);
}
template <class T>
PILEUS_FN Block<T> field_ahead(const DetailField& f, const Vec<T>& place, const Vec<T>& direction,
                               T width) {
    return field_ahead(f.grid, place, direction, width);
}
template <class T>
PILEUS_FN T field_density(const DetailField& f, const Vec<T>& place, T width) {
    const MediumView& m = *f.grid.medium;
    return with_detail(*m.detail, reduced(m, place), field_density(f.grid, place, width));
}
/// Of one medium.
template <class T, class Use>
PILEUS_FN void field_shares(const DetailField&, const Vec<T>&, T, Use use) {
    use(0, all<T>(1.0f));
}

template <int W>
PILEUS_FN void detail_raymarch_rows(const RaymarchParams& k, const RaymarchBuffers& b,
                                    std::uint32_t begin, std::uint32_t end) {
    raymarch_blocks<W>(k, b, DetailField{grid_field<false>(k, b)}, begin, end);
}

template <int W>
PILEUS_FN void detail_shadow_rows(const ShadowParams& k, const ShadowBuffers& b,
                                  std::uint32_t begin, std::uint32_t end) {
    shadow_rows<W, true>(k, b, begin, end);
}

template <int W>
PILEUS_FN void detail_march_rows(const MarchParams& k, const MarchBuffers& b, std::uint32_t begin,
                                 std::uint32_t end) {
    march_blocks<W, false, true>(k, b, begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
