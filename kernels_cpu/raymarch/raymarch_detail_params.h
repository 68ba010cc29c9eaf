// SPDX-License-Identifier: Apache-2.0
// The kernels that march through a medium with detail beyond its grid.
// in: params whose MediumView::detail is set, of one medium without constant cells -> out: as the
// kernels of the same names in KernelTable. docs/detail.md
#pragma once
#include "kernels_cpu/raymarch/raymarch_params.h"

namespace pileus {

/// A table of functions, one for each instruction set.
struct DetailKernels {
    void (*shadow_rows)(const ShadowParams&, const ShadowBuffers&, std::uint32_t, std::uint32_t);
    void (*march_rows)(const MarchParams&, const MarchBuffers&, std::uint32_t, std::uint32_t);
    void (*raymarch_rows)(const RaymarchParams&, const RaymarchBuffers&, std::uint32_t,
                          std::uint32_t);
};

}  // namespace pileus
