// SPDX-License-Identifier: Apache-2.0
// See majorants.h.
// in: densities, cells -> out: marks per cell, raised majorants.
// docs/photon-grid.md, "Deposits".
#include <algorithm>

#include "platform/threads.h"
#include "src/world/majorant/majorant.h"
#include "src/world/majorant/majorants.h"

namespace pileus {
namespace {

struct Range {
    int begin, end;
};

/// The largest whole number that is not over a / b, b > 0.
std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// Voxels whose trilinear footprint, half a voxel more on each side, reaches into cell c of n along
/// an axis of `size` voxels.
Range voxels_of_cell(int c, int n, int size) {
    const std::int64_t low = std::int64_t(2) * c * size - 3 * n;
    const std::int64_t high = std::int64_t(2) * (c + 1) * size + n;
    return {int(floor_div(low, 2 * n)) + 1, int(-floor_div(-high, 2 * n))};
}

/// Cells that share a volume with voxels [first, last) of an axis of `size` voxels.
Range cells_of_voxels(int first, int last, int n, int size) {
    const std::int64_t low = std::int64_t(first) * n / size;
    const std::int64_t high = (std::int64_t(last) * n + size - 1) / size;
    return {int(low), int(high < n ? high : n)};
}

/// The index of a voxel or cell beside the grid: across a period, or -1.
int folded(int i, int size, bool wraps) {
    if (i >= 0 && i < size) return i;
    if (!wraps) return -1;
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

bool holds_medium(const Medium& m, const CellGrid& cells, int x, int y, int z) {
    const Grid& g = m.grid;
    const Range zs = voxels_of_cell(z, cells.size[2], g.size[2]);
    const Range ys = voxels_of_cell(y, cells.size[1], g.size[1]);
    const Range xs = voxels_of_cell(x, cells.size[0], g.size[0]);
    for (int k = zs.begin; k < zs.end; ++k) {
        const int vz = folded(k, g.size[2], false);
        if (vz < 0) continue;
        for (int j = ys.begin; j < ys.end; ++j) {
            const int vy = folded(j, g.size[1], g.periodic);
            if (vy < 0) continue;
            for (int i = xs.begin; i < xs.end; ++i) {
                const int vx = folded(i, g.size[0], g.periodic);
                if (vx >= 0 && m.volume.density[voxel_index(g, vx, vy, vz)] > 0) return true;
            }
        }
    }
    return false;
}

std::size_t cell_index(const CellGrid& c, int x, int y, int z) {
    return (std::size_t(z) * std::size_t(c.size[1]) + std::size_t(y)) * std::size_t(c.size[0]) +
           std::size_t(x);
}

/// Cells around those that hold medium are read where its light is interpolated.
void mark_beside(const CellGrid& c, bool periodic, Span<std::uint8_t> marks) {
    for (int z = 0; z < c.size[2]; ++z)
        for (int y = 0; y < c.size[1]; ++y)
            for (int x = 0; x < c.size[0]; ++x) {
                if (marks[cell_index(c, x, y, z)] != kCellHolds) continue;
                for (int n = 0; n < 27; ++n) {
                    const int i = folded(x + n % 3 - 1, c.size[0], periodic);
                    const int j = folded(y + n / 3 % 3 - 1, c.size[1], periodic);
                    const int k = folded(z + n / 9 - 1, c.size[2], false);
                    if (i < 0 || j < 0 || k < 0) continue;
                    std::uint8_t& mark = marks[cell_index(c, i, j, k)];
                    if (mark == kCellEmpty) mark = kCellBeside;
                }
            }
}

/// Whether block (x, y, z) shares a volume with a marked cell.
bool block_is_near(const Grid& g, int block, const CellGrid& c, Span<const std::uint8_t> marks,
                   const int (&at)[3]) {
    Range r[3];
    for (int a = 0; a < 3; ++a) {
        const std::int64_t last = (std::int64_t(at[a]) + 1) * block;
        r[a] = cells_of_voxels(at[a] * block, last < g.size[a] ? int(last) : g.size[a], c.size[a],
                               g.size[a]);
    }
    for (int z = r[2].begin; z < r[2].end; ++z)
        for (int y = r[1].begin; y < r[1].end; ++y)
            for (int x = r[0].begin; x < r[0].end; ++x)
                if (marks[cell_index(c, x, y, z)] != kCellEmpty) return true;
    return false;
}

/// Density at which the mean free path is the edge of a cell.
float floor_density(const Medium& medium, const CellGrid& cells) {
    double volume = 1;
    for (int a = 0; a < 3; ++a) volume *= medium.extent_m[a] / cells.size[a];
    // Cube root by Newton's steps, so that no library decides.
    double edge = 1;
    while (edge * edge * edge > volume) edge *= 0.5;
    while (edge * edge * edge < volume) edge *= 2;
    for (int i = 0; i < 8; ++i) edge = (2 * edge + volume / (edge * edge)) / 3;
    // A float holds it, so that no free flight has length 0.
    return medium.sigma > 0 ? float(std::min(1 / (edge * double(medium.sigma)), 0x1p100)) : 0.0f;
}

void raise_blocks(const Medium& medium, const CellGrid& cells, int threads, CellMajorants& near,
                  Majorants& out) {
    const float floor = floor_density(medium, cells);
    int counts[3];
    block_counts(medium.grid, out.block, counts);
    const auto marks = near.marks.span();
    parallel_for(threads, counts[2], [&](std::int64_t z, int) {
        for (int y = 0; y < counts[1]; ++y)
            for (int x = 0; x < counts[0]; ++x) {
                const int at[3] = {x, y, int(z)};
                float& bound =
                    out.tracking[(std::size_t(z) * std::size_t(counts[1]) + std::size_t(y)) *
                                     std::size_t(counts[0]) +
                                 std::size_t(x)];
                if (bound < floor && block_is_near(medium.grid, out.block, cells, marks, at))
                    bound = floor;
            }
    });
    near.least_density = 0;
    for (float bound : out.tracking.span())
        if (bound > 0 && (near.least_density == 0 || bound < near.least_density))
            near.least_density = bound;
    if (near.least_density == 0) near.least_density = 1;
}

}  // namespace

Status make_cell_majorants(const Medium& medium, bool local, const CellGrid& cells,
                           const Context& context, Majorants& out, CellMajorants& near) {
    PILEUS_TRY(make_majorants(medium, local, context, out, kPhotonTracking));
    const StageClock clock(context, "majorants");
    PILEUS_TRY(allocate(arrays::cell_marks(cells.count()), near.marks));
    parallel_for(context.threads, cells.size[2], [&](std::int64_t z, int) {
        for (int y = 0; y < cells.size[1]; ++y)
            for (int x = 0; x < cells.size[0]; ++x)
                near.marks[cell_index(cells, x, y, int(z))] =
                    holds_medium(medium, cells, x, y, int(z)) ? kCellHolds : kCellEmpty;
    });
    mark_beside(cells, medium.grid.periodic, near.marks.span());
    near.marked = 0;
    for (std::uint8_t mark : near.marks.span()) near.marked += mark != kCellEmpty ? 1 : 0;
    raise_blocks(medium, cells, context.threads, near, out);
    int counts[3];
    block_counts(medium.grid, out.block, counts);
    mark_empty_blocks(out.tracking.span(), counts, context.threads);
    return Status::ok();
}

}  // namespace pileus
