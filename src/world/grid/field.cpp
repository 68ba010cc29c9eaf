// SPDX-License-Identifier: Apache-2.0
// See grid.h.
// in: densities at voxel centres -> out: density at a point, mass of each voxel.
// The mean of a clamped linear interpolant over one voxel is [1 6 1]/8 on each axis.
#include "platform/threads.h"
#include "src/world/grid/grid.h"

namespace pileus {
namespace {

struct Corner {
    int low, high;
    float t;
};

/// Finds the two voxel centres around a voxel coordinate, clamped to the rim or beyond it.
Corner corner(float x, int size, bool wraps = false) {
    const float c = x - 0.5f;
    if (wraps && c < 0.0f) return {size - 1, 0, c + 1.0f};
    if (wraps && c >= float(size - 1)) return {size - 1, 0, c - float(size - 1)};
    if (!(c > 0.0f)) return {0, 0, 0.0f};
    if (c >= float(size - 1)) return {size - 1, size - 1, 0.0f};
    const int low = int(c);
    return {low, low + 1, c - float(low)};
}

/// The voxel that holds a voxel coordinate.
int voxel_at(float x, int size) { return !(x > 0.0f) ? 0 : x < float(size) ? int(x) : size - 1; }

float mix(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

float density_at(Span<const float> density, const Grid& grid, const float x[3]) {
    if (grid.constant)
        return density[voxel_index(grid, voxel_at(x[0], grid.size[0]), voxel_at(x[1], grid.size[1]),
                                   voxel_at(x[2], grid.size[2]))];
    const Corner a = corner(x[0], grid.size[0], grid.periodic);
    const Corner b = corner(x[1], grid.size[1], grid.periodic);
    const Corner c = corner(x[2], grid.size[2]);
    const auto along_x = [&](int j, int k) {
        return mix(density[voxel_index(grid, a.low, j, k)],
                   density[voxel_index(grid, a.high, j, k)], a.t);
    };
    const float low = mix(along_x(b.low, c.low), along_x(b.high, c.low), b.t);
    const float high = mix(along_x(b.low, c.high), along_x(b.high, c.high), b.t);
    return mix(low, high, c.t);
}

void mass_row(Span<const float> density, const Grid& grid, const int (&range)[2], int j, int k,
              double* out) {
    const double volume = double(grid.cell_m[0]) * double(grid.cell_m[1]) * double(grid.cell_m[2]);
    if (grid.constant) {
        for (int i = range[0]; i < range[1]; ++i)
            out[i - range[0]] = double(density[voxel_index(grid, i, j, k)]) * volume;
        return;
    }
    const int nx = grid.size[0], ny = grid.size[1], nz = grid.size[2];
    const bool wraps = grid.periodic;
    const int js[3] = {j > 0 ? j - 1 : (wraps ? ny - 1 : 0), j,
                       j + 1 < ny ? j + 1 : (wraps ? 0 : j)};
    const int ks[3] = {k > 0 ? k - 1 : 0, k, k + 1 < nz ? k + 1 : k};
    const float* row[3][3];
    for (int c = 0; c < 3; ++c)
        for (int b = 0; b < 3; ++b) row[c][b] = density.data + voxel_index(grid, 0, js[b], ks[c]);
    // Sum the 3x3 rows around (j, k) with weights 1 6 1.
    const auto across = [&](int i) {
        double layer[3];
        for (int c = 0; c < 3; ++c)
            layer[c] = double(row[c][0][i]) + 6.0 * double(row[c][1][i]) + double(row[c][2][i]);
        return layer[0] + 6.0 * layer[1] + layer[2];
    };
    const int begin = range[0], end = range[1], count = end - begin;
    const double first = across(begin > 0 ? begin - 1 : (wraps ? nx - 1 : 0));
    const double last = across(end < nx ? end : (wraps ? 0 : nx - 1));
    for (int i = 0; i < count; ++i) out[i] = across(begin + i);
    // Then 1 6 1 along x, in place: keep the left neighbour while the row is overwritten.
    const double scale = volume / 512.0;
    double left = first;
    for (int i = 0; i < count; ++i) {
        const double here = out[i];
        out[i] = (left + 6.0 * here + (i + 1 < count ? out[i + 1] : last)) * scale;
        left = here;
    }
}

void voxel_masses(Span<const float> density, const Grid& grid, int threads, Span<double> masses) {
    assert(density.size == voxel_count(grid) && masses.size == density.size);
    parallel_for(threads, grid.size[2], [&](std::int64_t k, int) {
        for (int j = 0; j < grid.size[1]; ++j)
            mass_row(density, grid, {0, grid.size[0]}, j, int(k),
                     masses.data + voxel_index(grid, 0, j, int(k)));
    });
}

}  // namespace pileus
