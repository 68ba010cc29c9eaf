// SPDX-License-Identifier: Apache-2.0
// Local variance of the density: the other weight by which samples may be drawn.
// in: densities at voxel centres -> out: variance per voxel, maximum and sum.
// Elek 2011, section 5.1, footnote; separable box sums of integers, so every order is exact.
#include "platform/threads.h"
#include "src/base/buffer.h"
#include "src/methods/collectors/prepare/field_stats.h"
#include "src/methods/collectors/prepare/gradient.h"

namespace pileus {
namespace {

constexpr float kLevels = 262144.0f;  // 2^18: count^2 * level^2 < 2^61 for 17^3 voxels
constexpr float kSmallest = 1e-30f;   // below it the scale of the levels would overflow

using Sums = VarianceSums;

struct Variance {
    Span<const float> density;
    Grid grid;
    int radius;
    float scale;       ///< levels per density
    Span<Sums> boxes;  ///< per voxel: over the square of voxels in its slice
    Span<float> field;

    /// Sums along x into `row` with a sliding window.
    void sum_x(int j, int k, Sums* row) const {
        const int nx = grid.size[0];
        const float* values = density.data + voxel_index(grid, 0, j, k);
        const auto level = [&](int i) { return std::int64_t(values[i] * scale + 0.5f); };
        Sums window{0, 0};
        for (int i = 0; i < radius && i < nx; ++i) add(window, level(i), 1);
        for (int i = 0; i < nx; ++i) {
            if (i + radius < nx) add(window, level(i + radius), 1);
            row[i] = window;
            if (i - radius >= 0) add(window, level(i - radius), -1);
        }
    }

    static void add(Sums& s, std::int64_t q, std::int64_t sign) {
        s.first += sign * q;
        s.second += sign * q * q;
    }

    /// Adds sign * from to into, element by element.
    static void add_row(Sums* into, const Sums* from, std::int64_t sign, int count) {
        for (int i = 0; i < count; ++i) {
            into[i].first += sign * from[i].first;
            into[i].second += sign * from[i].second;
        }
    }

    /// Sums one slice over squares; `rows` holds the slice's sums along x, `window` one row.
    void sum_slice(int k, Sums* rows, Sums* window) const {
        const int nx = grid.size[0], ny = grid.size[1];
        const auto row = [&](int j) { return rows + std::size_t(j) * std::size_t(nx); };
        for (int j = 0; j < ny; ++j) sum_x(j, k, row(j));
        for (int i = 0; i < nx; ++i) window[i] = Sums{0, 0};
        for (int j = 0; j < radius && j < ny; ++j) add_row(window, row(j), 1, nx);
        for (int j = 0; j < ny; ++j) {
            if (j + radius < ny) add_row(window, row(j + radius), 1, nx);
            Sums* out = boxes.data + voxel_index(grid, 0, j, k);
            for (int i = 0; i < nx; ++i) out[i] = window[i];
            if (j - radius >= 0) add_row(window, row(j - radius), -1, nx);
        }
    }

    /// Slides upwards over the slices for one j and turns the sums into variances.
    void finish_row(int j, Sums* window) const {
        const int nx = grid.size[0], nz = grid.size[2];
        const auto row = [&](int k) { return boxes.data + voxel_index(grid, 0, j, k); };
        const std::int64_t edge = 2 * radius + 1, count = edge * edge * edge;
        const double per = 1.0 / (double(count) * double(scale));
        for (int i = 0; i < nx; ++i) window[i] = Sums{0, 0};
        for (int k = 0; k < radius && k < nz; ++k) add_row(window, row(k), 1, nx);
        for (int k = 0; k < nz; ++k) {
            if (k + radius < nz) add_row(window, row(k + radius), 1, nx);
            float* out = field.data + voxel_index(grid, 0, j, k);
            for (int i = 0; i < nx; ++i) {
                const Sums& s = window[i];
                out[i] = float(double(count * s.second - s.first * s.first) * per * per);
            }
            if (k - radius >= 0) add_row(window, row(k - radius), -1, nx);
        }
    }
};

}  // namespace

Status local_variance(Span<const float> density, const Grid& grid, int radius, int threads,
                      Span<float> field, FieldStats& stats) {
    assert(density.size == voxel_count(grid) && field.size == density.size);
    assert(radius >= 1 && radius <= kMaxVarianceRadius);
    PILEUS_TRY(field_stats(density, density, grid, threads, stats));
    for (float& f : field) f = 0.0f;
    if (!(stats.density_max > kSmallest)) return field_stats(density, field, grid, threads, stats);

    const std::uint64_t workers = threads > 1 ? std::uint64_t(threads) : 1;
    const std::size_t nx = std::size_t(grid.size[0]);
    const std::size_t slice = nx * std::size_t(grid.size[1]);
    Buffer<Sums> boxes, rows, windows;
    PILEUS_TRY(allocate(arrays::variance_sums(grid), boxes));
    PILEUS_TRY(allocate(arrays::variance_slices(grid, workers), rows));
    PILEUS_TRY(allocate(arrays::variance_rows(grid, workers), windows));
    const Variance v{density, grid, radius, kLevels / stats.density_max, boxes.span(), field};
    parallel_for(threads, grid.size[2], [&](std::int64_t k, int thread) {
        v.sum_slice(int(k), rows.data() + slice * std::size_t(thread),
                    windows.data() + nx * std::size_t(thread));
    });
    parallel_for(threads, grid.size[1], [&](std::int64_t j, int thread) {
        v.finish_row(int(j), windows.data() + nx * std::size_t(thread));
    });
    return field_stats(density, field, grid, threads, stats);
}

}  // namespace pileus
