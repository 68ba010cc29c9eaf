// SPDX-License-Identifier: Apache-2.0
// Sun's depths of media made by hand, and what they should be: rays integrated in double.
// in: sizes, seeds, directions -> out: depths per node, one ray's depth, mirrored grids.
// docs/buffer.md
#pragma once
#include "src/picture/nodes/sun_depth.h"
#include "tests/support/trace_harness.h"

namespace sun_depth_test {

using namespace pileus;

struct Rig {
    Medium medium;
    Majorants majorants;
};

/// Random densities in [0, 1), one in three of them 0.
inline Rig random_box(std::array<int, 3> size, Double3 extent_m, double sigma) {
    Rig rig;
    Medium& m = rig.medium;
    m.volume.size = size;
    for (std::size_t a = 0; a < 3; ++a) {
        m.extent_m[a] = extent_m[a];
        m.grid.size[a] = size[a];
        m.grid.cell_m[a] = float(extent_m[a] / size[a]);
    }
    REQUIRE(m.volume.density.resize(voxel_count(m.grid), "density"));
    std::uint32_t v = 0;
    for (float& density : m.volume.density.span()) {
        const Words<std::uint32_t> w = threefry(7u, 17u, v++, 0u);
        density = w.b % 3 == 0 ? 0.0f : uniform(w.a);
    }
    m.density_max = 1;
    m.sigma = float(sigma);
    return rig;
}

inline Context context_of(const KernelTable* kernels, int threads, Report& report) {
    Context context;
    context.kernels = kernels;
    context.threads = threads;
    context.report = &report;
    return context;
}

/// Blocks to skip for rays, as they are now.
inline void bound(const Rig& rig, Majorants& majorants) {
    REQUIRE(majorant_grid(rig.medium.volume.density.span(), rig.medium.grid, majorants.skip_block,
                          1, majorants.skipping));
}

inline std::vector<float> depths(const Rig& rig, const std::array<float, 3>& to_sun,
                                 const KernelTable* kernels = kernel_table(nullptr),
                                 int threads = 1, SunDepthKind kind = SunDepthKind::kSwept) {
    Report report;
    Majorants majorants;
    bound(rig, majorants);
    SunDepth depth;
    REQUIRE(make_sun_depth(context_of(kernels, threads, report), rig.medium, majorants, to_sun,
                           kind, depth));
    REQUIRE(depth.swept == (kind == SunDepthKind::kSwept));
    return {depth.optical_depth.span().begin(), depth.optical_depth.span().end()};
}

inline SweepCheck difference(const Rig& rig, const std::array<float, 3>& to_sun) {
    Report report;
    const Context context = context_of(kernel_table(nullptr), 1, report);
    Majorants majorants;
    bound(rig, majorants);
    SunDepth depth;
    SweepCheck d;
    REQUIRE(make_sun_depth(context, rig.medium, majorants, to_sun, SunDepthKind::kSwept, depth));
    REQUIRE(sun_depth_difference(context, rig.medium, majorants, to_sun, depth, 4096, d));
    return d;
}

template <class Use>
void for_nodes(const Grid& grid, Use use) {
    for (int k = 0; k < grid.size[2]; ++k)
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i)
                use(std::array<int, 3>{i, j, k}, voxel_index(grid, i, j, k));
}

inline std::vector<float> mirrored(const std::vector<float>& from, const Grid& grid, int axis) {
    std::vector<float> to(from.size());
    for_nodes(grid, [&](std::array<int, 3> at, std::size_t node) {
        at[std::size_t(axis)] = grid.size[axis] - 1 - at[std::size_t(axis)];
        to[voxel_index(grid, at[0], at[1], at[2])] = from[node];
    });
    return to;
}

inline double slice_sum(const Grid& grid, const std::vector<float>& depth, int slice) {
    double sum = 0;
    for_nodes(grid, [&](const std::array<int, 3>& at, std::size_t node) {
        if (at[2] == slice) sum += double(depth[node]);
    });
    return sum;
}

/// The axis with the most voxels a metre of the way.
inline int slice_axis(const Grid& grid, const std::array<float, 3>& sun) {
    int axis = 2;
    const auto speed = [&](int a) {
        return std::fabs(double(sun[std::size_t(a)])) / double(grid.cell_m[a]);
    };
    for (int a = 1; a >= 0; --a)
        if (speed(a) > speed(axis)) axis = a;
    return axis;
}

/// Whether fewer slices lie between a node and the top than voxels between it and the sides: a
/// neighbour more each slice, the sides' lack of medium has not got there.
inline bool knows_no_side(const Grid& grid, const std::array<int, 3>& at,
                          const std::array<float, 3>& sun) {
    const int axis = slice_axis(grid, sun);
    const auto ahead = [&](int a) {
        const int i = at[std::size_t(a)];
        return sun[std::size_t(a)] > 0 ? grid.size[a] - 1 - i : i;
    };
    for (int a = 0; a < 3; ++a)
        if (a != axis && sun[std::size_t(a)] != 0 && ahead(a) <= ahead(axis)) return false;
    return true;
}

/// The trilinear density, clamped to the outermost centres; voxel coordinates.
inline double density_at(const Medium& m, const double (&p)[3]) {
    int low[3];
    double share[3];
    for (int a = 0; a < 3; ++a) {
        const double c = std::min(std::max(p[a] - 0.5, 0.0), double(m.grid.size[a] - 1));
        low[a] = std::min(int(c), std::max(0, m.grid.size[a] - 2));
        share[a] = c - low[a];
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        int at[3];
        for (int a = 0; a < 3; ++a) {
            const int up = (corner >> a) & 1;
            at[a] = std::min(low[a] + up, m.grid.size[a] - 1);
            weight *= up != 0 ? share[a] : 1 - share[a];
        }
        sum += weight * double(m.volume.density[voxel_index(m.grid, at[0], at[1], at[2])]);
    }
    return sum;
}

/// From a node to the box's end: Simpson's rule on each piece within one cell, so exact.
inline double ray_depth(const Medium& m, const std::array<int, 3>& node,
                        const std::array<float, 3>& to_sun) {
    double d[3], length = 0, end = 1e300;
    for (std::size_t a = 0; a < 3; ++a) length += double(to_sun[a]) * double(to_sun[a]);
    for (int a = 0; a < 3; ++a)
        d[a] = double(to_sun[std::size_t(a)]) / std::sqrt(length) / double(m.grid.cell_m[a]);
    std::vector<double> cuts{0};
    for (int a = 0; a < 3; ++a) {
        if (d[a] == 0) continue;
        const double at = node[std::size_t(a)] + 0.5;
        end = std::min(end, (d[a] > 0 ? m.grid.size[a] - at : at) / std::fabs(d[a]));
        for (int n = 1; n <= m.grid.size[a]; ++n) cuts.push_back(n / std::fabs(d[a]));
    }
    cuts.push_back(end);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size() && cuts[i + 1] <= end; ++i) {
        const double width = cuts[i + 1] - cuts[i];
        const double weights[3] = {1, 4, 1};
        for (int s = 0; s < 3; ++s) {
            double p[3];
            for (int a = 0; a < 3; ++a)
                p[a] = node[std::size_t(a)] + 0.5 + d[a] * (cuts[i] + 0.5 * s * width);
            sum += width / 6 * weights[s] * density_at(m, p);
        }
    }
    return sum * double(m.sigma);
}

}  // namespace sun_depth_test
