// SPDX-License-Identifier: Apache-2.0
// See shapes.h. Cells cut by the surface are sampled 8 x 8 x 8 times.
// in: a resolution -> out: densities.
#include "src/world/density/shapes.h"

#include <cmath>
#include <string>

#include "src/base/angles.h"
#include "src/scene/rows/density_row.h"

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

Status allocate(const std::array<int, 3>& resolution, Volume& volume) {
    const auto cells =
        std::uint64_t(resolution[0]) * std::uint64_t(resolution[1]) * std::uint64_t(resolution[2]);
    PILEUS_TRY(volume.density.resize(cells, "uniform shape"));
    volume.size = resolution;
    volume.knows_bounds = false;
    return Status::ok();
}

/// Light is kept by cell, so cells of a box are half an optical depth along each axis, up to 64.
int box_cells(double depth) {
    constexpr double kDepthOfCell = 0.5;
    constexpr int kMax = 64;
    if (!(depth > kDepthOfCell)) return 1;
    return depth < kMax * kDepthOfCell ? int(std::ceil(depth / kDepthOfCell)) : kMax;
}

DensityOutline outline_box(const MediumSettings& medium) {
    DensityOutline outline{{1, 1, 1}, 1, 0, 0};
    for (std::size_t a = 0; a < 3; ++a)
        outline.size[a] =
            box_cells((medium.box.bounds_m[1][int(a)] - medium.box.bounds_m[0][int(a)]) *
                      medium.optics.extinction_per_m);
    return outline;
}

constexpr DensityRow box_row() {
    DensityRow row;
    row.name = "uniform:box";
    row.outline = outline_box;
    row.make = [](const MediumSettings&, const DensityMaking& with, Volume& volume) {
        return make_box(with.size, volume);
    };
    return row;
}

/// The sphere is the ellipsoid: it is round in metres when the box is a cube.
constexpr DensityRow round_row(const char* name) {
    DensityRow row;
    row.name = name;
    row.outline = [](const MediumSettings&) {
        constexpr double kMean = kPi64 / 6;  // share of its box that it fills
        return DensityOutline{{64, 64, 64}, kMean, 0, 0};
    };
    row.mean_within = 1.0002;
    row.make = [](const MediumSettings&, const DensityMaking& with, Volume& volume) {
        return make_ellipsoid(with.size, volume);
    };
    return row;
}

}  // namespace

Status make_box(const std::array<int, 3>& resolution, Volume& volume) {
    PILEUS_TRY(allocate(resolution, volume));
    for (float& v : volume.density.span()) v = 1.0f;
    return Status::ok();
}

Status make_ellipsoid(const std::array<int, 3>& resolution, Volume& volume) {
    PILEUS_TRY(allocate(resolution, volume));
    fill_ellipsoid(resolution, volume.density);
    return Status::ok();
}

extern const DensityRow kBoxDensity, kSphereDensity, kEllipsoidDensity;
constexpr DensityRow kBoxDensity = box_row();
constexpr DensityRow kSphereDensity = round_row("uniform:sphere");
constexpr DensityRow kEllipsoidDensity = round_row("uniform:ellipsoid");

}  // namespace pileus
