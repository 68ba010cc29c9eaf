// SPDX-License-Identifier: Apache-2.0
// A tile of numbers that differ most from those beside them: noise without low frequencies.
// in: nothing -> out: kNoiseTile^2 numbers in [0, 1), each once, that repeat without a seam.
// docs/raymarch.md, "Jitter"; Ulichney 1993, "The void-and-cluster method for dither array
// generation".
#pragma once
#include "kernels_cpu/raymarch/raymarch_params.h"
#include "src/plan/array.h"

namespace pileus {

namespace arrays {

/// `last` marches.
inline Array<float> blue_noise(Stage last) {
    return {"blue noise", std::uint64_t{kNoiseTile} * kNoiseTile, Stage::kShadow, last};
}

}  // namespace arrays

/// The same tile on every machine. kLimit: out of memory.
Status make_blue_noise(Buffer<float>& tile);

}  // namespace pileus
