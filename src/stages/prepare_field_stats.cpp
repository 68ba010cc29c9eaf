// SPDX-License-Identifier: Apache-2.0
// See prepare_field_stats.h.
// in: densities and weights -> out: FieldStats.
// One partial result per slice of constant z; slices are added from the bottom.
#include "src/stages/prepare_field_stats.h"

#include "platform/threads.h"
#include "src/base/buffer.h"

namespace pileus {

Status field_stats(Span<const float> density, Span<const float> field, const Grid& grid,
                   int threads, FieldStats& stats) {
    assert(density.size == voxel_count(grid) && field.size == density.size);
    const int nz = grid.size[2];
    const std::size_t slice_size = voxel_count(grid) / std::size_t(nz);
    Buffer<FieldStats> slices;
    PILEUS_TRY(slices.resize(std::uint64_t(nz), "statistics of the sampled field"));
    parallel_for(threads, nz, [&](std::int64_t k, int) {
        FieldStats s;
        const std::size_t begin = std::size_t(k) * slice_size;
        for (std::size_t i = begin; i < begin + slice_size; ++i) {
            s.max = field[i] > s.max ? field[i] : s.max;
            s.density_max = density[i] > s.density_max ? density[i] : s.density_max;
            s.sum += double(field[i]);
        }
        slices[std::size_t(k)] = s;
    });
    stats = FieldStats{};
    for (const FieldStats& s : slices.span()) {
        stats.max = s.max > stats.max ? s.max : stats.max;
        stats.density_max = s.density_max > stats.density_max ? s.density_max : stats.density_max;
        stats.sum += s.sum;
    }
    return Status::ok();
}

}  // namespace pileus
