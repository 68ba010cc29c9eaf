// SPDX-License-Identifier: Apache-2.0
// Tables from which the path tracer draws directions towards a sky map.
// in: a map's radiances -> out: texels' light per steradian of their share, cumulative.
// docs/path.md, "Sky maps"
#pragma once
#include "kernels_cpu/light/sky_sample.h"
#include "src/plan/array.h"

namespace pileus {

/// `view` points into the buffers and stays valid while they live, also when the whole is moved.
struct PathSky {
    Buffer<float> weight;
    Buffer<std::int32_t> row_cdf, column_cdf;
    SkySampler view{};

    std::uint64_t bytes() const { return weight.bytes() + row_cdf.bytes() + column_cdf.bytes(); }
};

namespace arrays {

/// Texels' light, and sums of it along the rows; and sums of the rows.
inline Array<float> path_sky_weight(std::uint64_t rows, std::uint64_t columns) {
    return {"directions to the sky map", rows * columns, Stage::kPaths, Stage::kPaths};
}
inline Array<std::int32_t> path_sky_columns(std::uint64_t rows, std::uint64_t columns) {
    return {"directions to the sky map", rows * columns, Stage::kPaths, Stage::kPaths};
}
inline Array<std::int32_t> path_sky_rows(std::uint64_t rows) {
    return {"directions to the sky map", rows, Stage::kPaths, Stage::kPaths};
}

}  // namespace arrays

/// Fills the tables for a map that shines somewhere; a black one is left without (no weight).
/// kLimit: out of memory.
Status make_path_sky(const SkyMapView& map, PathSky& out);

}  // namespace pileus
