// SPDX-License-Identifier: Apache-2.0
// Whose extinction a cell of the photon grid holds, where several media share it.
// in: densities of each medium, cells near medium -> out: shares that add up to 1.
// docs/photon-grid.md, "Several media".
#include "platform/threads.h"
#include "src/methods/photon_grid/grid_light.h"

namespace pileus {
namespace {

struct Box {
    int lo[3], hi[3];  ///< voxels, half-open
};

/// Voxels of cell `at` and `around` cells on each side, clamped to the grid, at least one.
Box voxels_around(const Grid& g, const CellGrid& cells, const int (&at)[3], int around) {
    Box box{};
    for (int a = 0; a < 3; ++a) {
        const std::int64_t n = cells.size[a], size = g.size[a];
        std::int64_t lo = (at[a] - around) * size / n - 1;
        std::int64_t hi = ((at[a] + 1 + around) * size + n - 1) / n + 1;
        if (lo < 0) lo = 0;
        if (hi > size) hi = size;
        box.lo[a] = int(lo);
        box.hi[a] = int(hi);
    }
    return box;
}

/// Sums of the media's densities over a box; the first is what the others leave.
void box_masses(const Medium& m, const Box& box, double* mass) {
    const std::size_t voxels = std::size_t(voxel_count(m.grid)), count = std::size_t(m.count);
    for (std::size_t i = 0; i < count; ++i) mass[i] = 0;
    for (int z = box.lo[2]; z < box.hi[2]; ++z)
        for (int y = box.lo[1]; y < box.hi[1]; ++y)
            for (int x = box.lo[0]; x < box.hi[0]; ++x) {
                const std::size_t v = std::size_t(voxel_index(m.grid, x, y, z));
                double left = double(m.volume.density[v]);
                for (std::size_t i = 1; i < count; ++i) {
                    const double part = double(m.parts[(i - 1) * voxels + v]);
                    mass[i] += part;
                    left -= part;
                }
                mass[0] += left > 0 ? left : 0;
            }
}

}  // namespace

Status make_cell_shares(const Medium& medium, const CellGrid& cells, Span<const std::uint8_t> marks,
                        int threads, Buffer<float>& shares) {
    const std::size_t count = std::size_t(medium.count);
    PILEUS_TRY(
        allocate(arrays::cell_shares(count > 1 ? cells.count() : 0, std::uint64_t(count)), shares));
    if (count < 2) return Status::ok();
    parallel_for(threads, cells.size[2], [&](std::int64_t z, int) {
        double mass[kMaxMedia];
        for (int y = 0; y < cells.size[1]; ++y)
            for (int x = 0; x < cells.size[0]; ++x) {
                const int at[3] = {x, y, int(z)};
                const std::size_t cell =
                    (std::size_t(z) * std::size_t(cells.size[1]) + std::size_t(y)) *
                        std::size_t(cells.size[0]) +
                    std::size_t(x);
                if (marks[cell] == kCellEmpty) continue;
                double sum = 0;
                for (int around = 0; around < 2 && !(sum > 0); ++around) {
                    box_masses(medium, voxels_around(medium.grid, cells, at, around), mass);
                    for (std::size_t i = 0; i < count; ++i) sum += mass[i];
                }
                for (std::size_t i = 0; i < count; ++i)
                    shares[cell * count + i] =
                        sum > 0 ? float(mass[i] / sum) : 1.0f / float(medium.count);
            }
    });
    return Status::ok();
}

}  // namespace pileus
