// SPDX-License-Identifier: Apache-2.0
// See gradient.h.
// in: densities at voxel centres -> out: gradient magnitude per voxel, maximum and sum.
// Elek 2011, section 5.1; docs/methods.md 7 for the sign in equation 5.1.
#include "src/methods/collectors/prepare/gradient.h"

#include <cmath>

#include "platform/threads.h"
#include "src/base/buffer.h"
#include "src/methods/collectors/prepare/field_stats.h"

namespace pileus {
namespace {

struct FieldRows {
    const float *here, *y_low, *y_high, *z_low, *z_high;
};

/// `low_end`, `high_end`: what lies before the row's first voxel and behind its last.
void gradient_row(const FieldRows& rows, int size, const float per_2h[3], float low_end,
                  float high_end, float* out) {
    const auto store = [&](int i, float low, float high) {
        const float gx = (high - low) * per_2h[0];
        const float gy = (rows.y_high[i] - rows.y_low[i]) * per_2h[1];
        const float gz = (rows.z_high[i] - rows.z_low[i]) * per_2h[2];
        out[i] = std::sqrt(gx * gx + gy * gy + gz * gz);
    };
    store(0, low_end, size > 1 ? rows.here[1] : high_end);
    for (int i = 1; i + 1 < size; ++i) store(i, rows.here[i - 1], rows.here[i + 1]);
    if (size > 1) store(size - 1, rows.here[size - 2], high_end);
}

}  // namespace

Status gradient_magnitude(Span<const float> density, const Grid& grid, int threads,
                          Span<float> field, FieldStats& stats) {
    assert(density.size == voxel_count(grid) && field.size == density.size);
    const int nx = grid.size[0], ny = grid.size[1], nz = grid.size[2];
    Buffer<float> nothing;
    PILEUS_TRY(allocate(arrays::empty_row(grid), nothing));
    float per_2h[3];
    for (int a = 0; a < 3; ++a) per_2h[a] = 0.5f / grid.cell_m[a];
    parallel_for(threads, nz, [&](std::int64_t slice, int) {
        const int k = int(slice);
        for (int j = 0; j < ny; ++j) {
            // Beyond the box lies nothing, or the same once more.
            const auto row = [&](int y, int z) {
                if (grid.periodic) y = (y + ny) % ny;
                const bool inside = y >= 0 && y < ny && z >= 0 && z < nz;
                return inside ? density.data + voxel_index(grid, 0, y, z) : nothing.data();
            };
            const FieldRows rows{row(j, k), row(j - 1, k), row(j + 1, k), row(j, k - 1),
                                 row(j, k + 1)};
            const float low_end = grid.periodic ? rows.here[nx - 1] : 0.0f;
            const float high_end = grid.periodic ? rows.here[0] : 0.0f;
            gradient_row(rows, nx, per_2h, low_end, high_end,
                         field.data + voxel_index(grid, 0, j, k));
        }
    });
    return field_stats(density, field, grid, threads, stats);
}

}  // namespace pileus
