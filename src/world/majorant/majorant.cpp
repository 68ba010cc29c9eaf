// SPDX-License-Identifier: Apache-2.0
// See majorant.h.
// in: densities -> out: the largest density per block of voxels, and the best size of a block.
// The maximum is separable: columns, then rows, then runs along x.
#include "src/world/majorant/majorant.h"

#include <algorithm>

#include "platform/threads.h"

namespace pileus {
namespace {

struct Range {
    int begin, end;
};

/// Voxels of block b and its one-voxel border, clamped to the grid.
Range footprint(int b, int block, int size) {
    const std::int64_t end = (std::int64_t(b) + 1) * block + 1;
    return {std::max(b * block - 1, 0), int(std::min<std::int64_t>(end, size))};
}

/// The voxel beyond the rim that block b of a periodic grid also touches; -1: none.
struct Beyond {
    int low, high;
};
Beyond beyond(const Grid& grid, int b, int block, int axis) {
    if (!grid.periodic || axis == 2) return {-1, -1};
    const bool last = (std::int64_t(b) + 1) * block >= grid.size[axis];
    return {b == 0 ? grid.size[axis] - 1 : -1, last ? 0 : -1};
}

void raise(float* into, const float* from, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) into[i] = from[i] > into[i] ? from[i] : into[i];
}

/// The largest number in each block's footprint along a row of `size`.
void raise_along(const float* row, int size, int block, int blocks, float* out) {
    if (block == 1) {
        const std::size_t rest = std::size_t(size) - 1;
        std::copy(row, row + size, out);
        raise(out, row + 1, rest);
        raise(out + 1, row, rest);
        return;
    }
    for (int b = 0; b < blocks; ++b) {
        const Range xs = footprint(b, block, size);
        float most = 0.0f;
        for (int i = xs.begin; i < xs.end; ++i) most = row[i] > most ? row[i] : most;
        out[b] = most;
    }
}

/// Edges of block b along one axis, metres; the last block may be cut short.
double block_edge_m(const Grid& grid, int axis, int block, int b) {
    const int voxels = std::min(block, grid.size[axis] - b * block);
    return double(voxels) * double(grid.cell_m[axis]);
}

constexpr int kLayers = 4;  // sums of so many layers run side by side: none waits for its last

/// Costs of up to kLayers layers of blocks of constant z, from layer `first` on.
void layer_costs(const Grid& grid, int block, int first, int layers, Span<const float> majorants,
                 double sigma, const TrackingCosts& costs, double* totals) {
    int n[3];
    block_counts(grid, block, n);
    const std::size_t row = std::size_t(n[0]), layer = row * std::size_t(n[1]);
    double total[kLayers] = {};
    for (int by = 0; by < n[1]; ++by) {
        const double b = block_edge_m(grid, 1, block, by);
        // All blocks of a row but the last have the same edges.
        for (int part = 0; part < 2; ++part) {
            const int begin = part == 0 ? 0 : n[0] - 1, end = part == 0 ? n[0] - 1 : n[0];
            const double a = block_edge_m(grid, 0, block, begin);
            double volume[kLayers], surface[kLayers];
            const float* from[kLayers];
            for (int l = 0; l < kLayers; ++l) {
                const int bz = first + (l < layers ? l : 0);
                const double c = block_edge_m(grid, 2, block, bz);
                volume[l] = a * b * c;
                surface[l] = 0.5 * (a * b + b * c + c * a);
                from[l] = majorants.data + layer * std::size_t(bz) + row * std::size_t(by);
            }
            for (int bx = begin; bx < end; ++bx)
                for (int l = 0; l < kLayers; ++l) {
                    const double majorant = double(from[l][bx]);
                    total[l] += sigma * majorant * volume[l] * costs.tentative +
                                surface[l] * (majorant > 0 ? costs.crossing : costs.empty);
                }
        }
    }
    for (int l = 0; l < layers; ++l) totals[l] = total[l];
}

Status predicted_cost(const Grid& grid, int block, Span<const float> majorants, double sigma,
                      const TrackingCosts& costs, int threads, double& total) {
    int n[3];
    block_counts(grid, block, n);
    Buffer<double> parts;
    PILEUS_TRY(parts.resize(std::uint64_t(n[2]), "majorants: costs"));
    parallel_for(threads, (n[2] + kLayers - 1) / kLayers, [&](std::int64_t piece, int) {
        const int first = int(piece) * kLayers, layers = std::min(kLayers, n[2] - first);
        layer_costs(grid, block, first, layers, majorants, sigma, costs, parts.data() + first);
    });
    total = 0;
    for (double part : parts.span()) total += part;
    return Status::ok();
}

/// Joins blocks two by two: their footprints together are the larger block's footprint.
Status halve(const Grid& grid, int block, Span<const float> fine, int threads,
             Buffer<float>& coarse) {
    int from[3], to[3];
    block_counts(grid, block, from);
    block_counts(grid, 2 * block, to);
    PILEUS_TRY(allocate(arrays::block_maxima(grid, 2 * block), coarse));
    const std::size_t nx = std::size_t(to[0]), mx = std::size_t(from[0]);
    parallel_for(threads, to[2], [&](std::int64_t z, int) {
        for (int k = 2 * int(z); k < std::min(2 * int(z) + 2, from[2]); ++k)
            for (int j = 0; j < from[1]; ++j) {
                const std::size_t in =
                    (std::size_t(k) * std::size_t(from[1]) + std::size_t(j)) * mx;
                float* out =
                    coarse.data() + (std::size_t(z) * std::size_t(to[1]) + std::size_t(j / 2)) * nx;
                for (std::size_t i = 0; i < mx; ++i)
                    out[i / 2] = std::max(out[i / 2], fine[in + i]);
            }
    });
    return Status::ok();
}

}  // namespace

std::uint64_t block_total(const Grid& grid, int block) {
    int n[3];
    block_counts(grid, block, n);
    return std::uint64_t(n[0]) * std::uint64_t(n[1]) * std::uint64_t(n[2]);
}

Status majorant_grid(Span<const float> density, const Grid& grid, int block, int threads,
                     Buffer<float>& majorants) {
    assert(density.size == voxel_count(grid));
    int n[3];
    block_counts(grid, block, n);
    const std::size_t nx = std::size_t(grid.size[0]), ny = std::size_t(grid.size[1]);
    const std::size_t scratch = nx * ny + nx;
    const std::uint64_t workers = threads > 1 ? std::uint64_t(threads) : 1;
    Buffer<float> columns;
    PILEUS_TRY(allocate(arrays::majorant_rows(grid, workers), columns));
    PILEUS_TRY(allocate(arrays::block_maxima(grid, block), majorants));
    parallel_for(threads, n[2], [&](std::int64_t bz, int thread) {
        float* slice = columns.data() + scratch * std::size_t(thread);
        float* row = slice + nx * ny;
        // Maximum over the layer's slices, then over each block's rows, then along x.
        const Range zs = footprint(int(bz), block, grid.size[2]);
        std::fill(slice, slice + nx * ny, 0.0f);
        for (int k = zs.begin; k < zs.end; ++k)
            raise(slice, density.data + nx * ny * std::size_t(k), nx * ny);
        for (int by = 0; by < n[1]; ++by) {
            const Range ys = footprint(by, block, grid.size[1]);
            std::fill(row, row + nx, 0.0f);
            for (int j = ys.begin; j < ys.end; ++j) raise(row, slice + nx * std::size_t(j), nx);
            const Beyond more = beyond(grid, by, block, 1);
            for (int j : {more.low, more.high})
                if (j >= 0) raise(row, slice + nx * std::size_t(j), nx);
            float* out =
                majorants.data() +
                (std::size_t(bz) * std::size_t(n[1]) + std::size_t(by)) * std::size_t(n[0]);
            raise_along(row, grid.size[0], block, n[0], out);
            const Beyond first = beyond(grid, 0, block, 0), last = beyond(grid, n[0] - 1, block, 0);
            if (first.low >= 0) out[0] = std::max(out[0], row[first.low]);
            if (last.high >= 0) out[n[0] - 1] = std::max(out[n[0] - 1], row[last.high]);
        }
    });
    return Status::ok();
}

Status choose_block(Span<const float> density, const Grid& grid, double extinction_per_m,
                    const TrackingCosts& costs, int threads, BlockChoice& choice) {
    choice = BlockChoice{};
    const int whole = std::max(grid.size[0], std::max(grid.size[1], grid.size[2]));
    int block = voxel_count(grid) <= kMaxSingleVoxels ? 1 : 2;
    Buffer<float> fine, coarse;
    PILEUS_TRY(majorant_grid(density, grid, std::min(block, whole), threads, fine));
    double least = 0;
    for (;;) {
        // Stop at 32 voxels; whatever the doubling reached, end with one block for all.
        const int edge = std::min(block, whole);
        double cost = 0;
        PILEUS_TRY(predicted_cost(grid, edge, fine.span(), extinction_per_m, costs, threads, cost));
        choice.edge[choice.candidates] = edge;
        choice.cost[choice.candidates++] = cost;
        if (choice.block == 0 || cost <= least) choice.block = edge, least = cost;
        if (edge == whole) return Status::ok();
        if (block < 32) {
            PILEUS_TRY(halve(grid, block, fine.span(), threads, coarse));
            fine.swap(coarse);
            block *= 2;
        } else {
            const float largest = *std::max_element(fine.data(), fine.data() + fine.size());
            PILEUS_TRY(fine.resize(1, "majorants"));
            fine[0] = largest;
            block = whole;
        }
    }
}

}  // namespace pileus
