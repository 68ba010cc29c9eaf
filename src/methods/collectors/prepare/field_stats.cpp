// SPDX-License-Identifier: Apache-2.0
// See field_stats.h.
// in: densities and weights -> out: FieldStats.
// One partial result per slice of constant z; slices are added from the bottom.
#include "src/methods/collectors/prepare/field_stats.h"

#include <algorithm>

#include "platform/threads.h"
#include "src/base/buffer.h"

namespace pileus {
namespace {

constexpr std::size_t kStrip = 8;  // maxima side by side

float largest(const float* values, std::size_t count) {
    float most[kStrip] = {};
    std::size_t i = 0;
    for (; i + kStrip <= count; i += kStrip)
        for (std::size_t l = 0; l < kStrip; ++l)
            most[l] = values[i + l] > most[l] ? values[i + l] : most[l];
    for (; i < count; ++i) most[0] = values[i] > most[0] ? values[i] : most[0];
    for (float m : most) most[0] = m > most[0] ? m : most[0];
    return most[0];
}

}  // namespace

void sums_abreast(const float* values, std::size_t count, std::size_t stride, int rows,
                  double* sums) {
    assert(rows >= 1 && rows <= kAbreast);
    double sum[kAbreast] = {};
    if (rows == kAbreast) {
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t r = 0; r < kAbreast; ++r) sum[r] += double(values[r * stride + i]);
    } else {
        for (std::size_t r = 0; r < std::size_t(rows); ++r)
            for (std::size_t i = 0; i < count; ++i) sum[r] += double(values[r * stride + i]);
    }
    for (int r = 0; r < rows; ++r) sums[r] = sum[r];
}

Status field_stats(Span<const float> density, Span<const float> field, const Grid& grid,
                   int threads, FieldStats& stats) {
    assert(density.size == voxel_count(grid) && field.size == density.size);
    const int nz = grid.size[2];
    const std::size_t slice = voxel_count(grid) / std::size_t(nz);
    Buffer<FieldStats> slices;
    PILEUS_TRY(allocate(arrays::slice_stats(grid), slices));
    parallel_for(threads, (nz + kAbreast - 1) / kAbreast, [&](std::int64_t piece, int) {
        const int first = int(piece) * kAbreast, count = std::min(kAbreast, nz - first);
        double sums[kAbreast];
        sums_abreast(field.data + std::size_t(first) * slice, slice, slice, count, sums);
        for (int s = 0; s < count; ++s) {
            const std::size_t begin = std::size_t(first + s) * slice;
            slices[std::size_t(first) + std::size_t(s)] = {
                largest(field.data + begin, slice), sums[s], largest(density.data + begin, slice)};
        }
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
