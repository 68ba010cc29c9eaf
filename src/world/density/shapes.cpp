// SPDX-License-Identifier: Apache-2.0
// See shapes.h. Cells cut by the surface are sampled 8 x 8 x 8 times.
// in: a kind, a resolution -> out: densities.
#include "src/world/density/shapes.h"

#include <cmath>
#include <string>

namespace pileus {
namespace {

constexpr int kSub = 8;  // samples along a cell's edge

/// Squares of the least and the greatest distance from the box's middle in cell i of n; the box
/// reaches from -1 to 1.
struct Reach {
    double least, greatest;
};

Reach reach(int i, int n) {
    const double low = std::fabs(double(2 * i - n) / n),
                 high = std::fabs(double(2 * i + 2 - n) / n);
    const bool holds_middle = 2 * i < n && 2 * i + 2 > n;
    const double least = holds_middle ? 0.0 : low < high ? low : high;
    const double greatest = low < high ? high : low;
    return {least * least, greatest * greatest};
}

/// Square of the middle distance of sample s in cell i of n.
double sample_square(int i, int s, int n) {
    const double u = double(2 * (kSub * i + s) + 1 - kSub * n) / (double(kSub) * n);
    return u * u;
}

/// Share of a cell inside the unit sphere.
float coverage(int x, int y, int z, const std::array<int, 3>& n) {
    int inside = 0;
    for (int c = 0; c < kSub; ++c)
        for (int b = 0; b < kSub; ++b) {
            const double yz = sample_square(y, b, n[1]) + sample_square(z, c, n[2]);
            for (int a = 0; a < kSub; ++a) inside += yz + sample_square(x, a, n[0]) <= 1.0;
        }
    return float(inside) / float(kSub * kSub * kSub);
}

void fill_ellipsoid(const std::array<int, 3>& n, Buffer<float>& density) {
    std::size_t at = 0;
    for (int z = 0; z < n[2]; ++z)
        for (int y = 0; y < n[1]; ++y)
            for (int x = 0; x < n[0]; ++x, ++at) {
                const Reach rx = reach(x, n[0]), ry = reach(y, n[1]), rz = reach(z, n[2]);
                if (rx.least + ry.least + rz.least >= 1.0) continue;
                const bool whole = rx.greatest + ry.greatest + rz.greatest <= 1.0;
                density[at] = whole ? 1.0f : coverage(x, y, z, n);
            }
}

}  // namespace

std::array<int, 3> default_shape_size(DensityKind kind) {
    if (kind == DensityKind::kUniformBox) return {1, 1, 1};
    return {64, 64, 64};
}

Status make_shape(DensityKind kind, std::array<int, 3> resolution, Volume& volume) {
    const bool box = kind == DensityKind::kUniformBox;
    if (!box && kind != DensityKind::kUniformSphere && kind != DensityKind::kUniformEllipsoid)
        return Status::bad_input(
            "density: not a uniform shape, allowed uniform:box, "
            "uniform:sphere, uniform:ellipsoid");
    if (resolution == std::array<int, 3>{0, 0, 0}) resolution = default_shape_size(kind);
    for (int n : resolution)
        if (n < 1 || n > 4096)
            return Status::bad_input("resolution: " + std::to_string(n) +
                                     " cells, allowed 1..4096");
    const auto cells =
        std::uint64_t(resolution[0]) * std::uint64_t(resolution[1]) * std::uint64_t(resolution[2]);
    PILEUS_TRY(volume.density.resize(cells, "uniform shape"));
    if (box)
        for (float& v : volume.density.span()) v = 1.0f;
    else
        fill_ellipsoid(resolution, volume.density);
    volume.size = resolution;
    volume.knows_bounds = false;
    return Status::ok();
}

}  // namespace pileus
