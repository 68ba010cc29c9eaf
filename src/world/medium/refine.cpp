// SPDX-License-Identifier: Apache-2.0
// See refine.h.
// in: extinction and cells -> out: factors; densities at the middles of finer cells.
// docs/methods.md 2, "Cells for light"; docs/accuracy.md
#include "src/world/medium/refine.h"

#include <algorithm>
#include <cmath>

#include "platform/threads.h"
#include "src/base/number_text.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {
namespace {

/// Optical depth of a cell, where the medium is densest. Of 4 a thick ellipsoid is 9 to 12 % too
/// dark by photons, of 1.3 3 to 5, of 0.8 1 to 3 (docs/accuracy.md).
constexpr double kDepth = 1;
/// Along an axis of fewer cells light has no shape: by collectors a deck of one optical depth is
/// 17 % too dark in one cell, 4 % in five. Shallower cells have no need of one.
constexpr double kFewest = 4, kFewDepth = 0.25;
/// As many as cells of light have photons for; 2 MB of densities.
constexpr double kMaxFineCells = 0x1p19;
/// A box is flat that is so many times as wide as it is thick.
constexpr double kFlat = 16;

double cell_of(const Medium& m, int axis) { return m.extent_m[axis] / m.grid.size[axis]; }

/// The least odd number that is no less; `most` bounds it.
int odd_from(double least, int most) {
    const double odd = 2 * std::ceil((least - 1) / 2) + 1;
    if (odd <= 1 || most < 3) return 1;
    return odd <= most ? int(odd) : most % 2 == 1 ? most : most - 1;
}

/// Of parts of the density: medium 0 has no array of its own.
Status refine_values(const Grid& from, const Grid& to, const std::array<int, 3>& factor,
                     int threads, const Array<float>& array, std::uint64_t parts,
                     Buffer<float>& values) {
    Buffer<float> fine;
    PILEUS_TRY(allocate(array, fine));
    const std::size_t coarse_cells = voxel_count(from), cells = voxel_count(to);
    const auto at = [&](int cell, std::size_t axis) {
        return (float(cell) + 0.5f) / float(factor[axis]);
    };
    parallel_for(threads, to.size[2], [&](std::int64_t z, int) {
        for (std::uint64_t p = 0; p < parts; ++p) {
            const Span<const float> coarse{values.data() + p * coarse_cells, coarse_cells};
            float* row = fine.data() + p * cells + voxel_index(to, 0, 0, int(z));
            for (int y = 0; y < to.size[1]; ++y)
                for (int x = 0; x < to.size[0]; ++x) {
                    const float place[3] = {at(x, 0), at(y, 1), at(int(z), 2)};
                    *row++ = density_at(coarse, from, place);
                }
        }
    });
    values.swap(fine);
    return Status::ok();
}

}  // namespace

std::array<int, 3> finer_cells(const Medium& medium, const Limits& limits) {
    std::array<int, 3> factor{1, 1, 1};
    const double per_m = max_extinction(medium);
    const double most = std::min(kMaxFineCells, double(limits[LimitId::kVoxels]));
    if (!(per_m > 0) || double(voxel_count(medium.grid)) * 3 > most) return factor;
    const double thickness = *std::min_element(medium.extent_m, medium.extent_m + 3);
    const auto stays = [&](int a) {
        return medium.extent_m[a] > kFlat * thickness && cell_of(medium, a) > thickness;
    };
    const int side = int(std::min<std::uint64_t>(limits[LimitId::kSide], kMaxVolumeSide));
    double fewest = kFewest;
    for (double edge = kDepth / per_m;; edge *= 1.25, fewest /= 1.25) {
        double cells = 1;
        for (int a = 0; a < 3; ++a) {
            const std::size_t axis = std::size_t(a);
            // Light of one cell that repeats does not differ along it.
            const bool alike = medium.grid.periodic && a < 2 && medium.grid.size[a] == 1;
            const double few = std::min(fewest, medium.extent_m[a] * per_m / kFewDepth);
            const double least =
                std::max(cell_of(medium, a) / edge, alike ? 1 : few / medium.grid.size[a]);
            factor[axis] = stays(a) ? 1 : odd_from(least, side / medium.grid.size[a]);
            cells *= double(factor[axis]) * medium.grid.size[a];
        }
        if (cells <= most) return factor;
    }
}

Status refine_medium(const std::array<int, 3>& factor, int threads, Medium& medium) {
    const Grid from = medium.grid;
    refine_grid(factor, medium);
    if (medium.volume.density.size() > 0)
        PILEUS_TRY(refine_values(from, medium.grid, factor, threads, arrays::density(medium.grid),
                                 1, medium.volume.density));
    if (medium.parts.size() == 0) return Status::ok();
    const std::uint64_t media = std::uint64_t(medium.count);
    return refine_values(from, medium.grid, factor, threads,
                         arrays::media_parts(medium.grid, media), media - 1, medium.parts);
}

std::string told_finer_cells(const Medium& medium, const std::array<int, 3>& factor) {
    double depth = 0;
    std::string text = "light on cells ";
    for (int a = 0; a < 3; ++a) {
        const int times = factor[std::size_t(a)];
        text += (a > 0 ? " x " : "") + std::to_string(times);
        if (times > 1) depth = std::max(depth, cell_of(medium, a) * max_extinction(medium));
    }
    text +=
        " times as fine: the density's are up to " + number_text(depth) + " optical depths deep";
    return depth > kDepth ? text : text + ", and fewer than four along an axis";
}

}  // namespace pileus
