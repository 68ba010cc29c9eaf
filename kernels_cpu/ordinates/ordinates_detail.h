// SPDX-License-Identifier: Apache-2.0
// A march through light of discrete ordinates in a medium with detail, which is made on the way.
// in: a grid, a tile of noise, light on nodes -> out: planes of pixels, counts.
// docs/ordinates.md; docs/detail.md
#pragma once
#include "kernels_cpu/ordinates/ordinates_march.h"
#include "kernels_cpu/raymarch/raymarch_detail.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <int W>
PILEUS_FN void detail_ordinates_rows(const OrdinatesMarchParams& o, const OrdinatesMarchBuffers& n,
                                     std::uint32_t begin, std::uint32_t end) {
    ordinates_blocks<W>(o, n, DetailField{grid_field<false>(o.march, n.march)}, begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
