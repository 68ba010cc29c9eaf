// SPDX-License-Identifier: Apache-2.0
// See sweep_taps.h.
#include "src/picture/nodes/sweep_taps.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace pileus {
namespace {

double magnitude(double v) { return v < 0 ? -v : v; }

/// Floats are asked for; what is beyond them is as dark as darkness gets.
float weight_of(double v) { return v < 1e30 ? float(v) : 1e30f; }

/// The direction in voxels per metre.
std::array<double, 3> in_voxels(const Grid& grid, const std::array<float, 3>& to_sun) {
    double square = 0;
    for (float d : to_sun) square += double(d) * double(d);
    const double inverse = 1 / __builtin_sqrt(square);
    std::array<double, 3> v{};
    for (std::size_t a = 0; a < 3; ++a) v[a] = double(to_sun[a]) * inverse / double(grid.cell_m[a]);
    return v;
}

/// Share of the neighbour (0 or 1 steps away) at `t` slices along the ray; the grid's rim has none.
double share(int neighbour, double slope, bool rim, double t) {
    if (rim) return neighbour == 0 ? 1 : 0;
    return neighbour == 0 ? 1 - t * slope : t * slope;
}

/// 1 for the neighbour in whose voxel the ray is `t` slices along it, where voxels have one
/// density.
double inside(int neighbour, double slope, bool rim, double t) {
    const int steps = !rim && t * slope > 0.5 ? 1 : 0;
    return neighbour == steps ? 1 : 0;
}

/// Simpson's rule on [a, b].
template <class Function>
double simpson(double a, double b, Function f) {
    return (b - a) / 6 * (f(a) + 4 * f(0.5 * (a + b)) + f(b));
}

/// `slope`: voxels per slice along the lesser axes, both in [0, 1]; `length`: of a ray between two
/// slices, times the extinction.
SweepTaps open_taps(const double (&slope)[2], const bool (&rim)[2], bool top, bool constant,
                    double length) {
    // Centres of the outermost voxels lie half a voxel before the faces, where rays end.
    double end = top ? 0.5 : 1;
    for (int i = 0; i < 2; ++i)
        if (rim[i] && slope[i] * end > 0.5) end = 0.5 / slope[i];
    // Pieces on which the densities' shares are one formula: all of it, or within voxels.
    std::vector<double> at{0, end};
    if (constant)
        for (const double s : {slope[0], slope[1], 1.0})
            if (s * end > 0.5) at.push_back(0.5 / s);
    std::sort(at.begin(), at.end());
    const auto over = [&](const auto& weight) {
        double sum = 0;
        for (std::size_t p = 0; p + 1 < at.size(); ++p)
            sum += constant ? (at[p + 1] - at[p]) * weight(0.5 * (at[p] + at[p + 1]))
                            : simpson(at[p], at[p + 1], weight);
        return sum;
    };
    const auto part = constant ? inside : share;
    SweepTaps taps{};
    for (int i = 0; i < 4; ++i) {
        const int u = i & 1, v = i / 2;
        const auto beside = [&](double t) {
            return share(u, slope[0], rim[0], t) * share(v, slope[1], rim[1], t);
        };
        const auto held = [&](double t) {
            return part(u, slope[0], rim[0], t) * part(v, slope[1], rim[1], t);
        };
        const double near = over([&](double t) { return held(t) * part(0, 1, top, t); });
        const double far = over([&](double t) { return held(t) * part(1, 1, top, t); });
        taps.near[i] = weight_of(near * length);
        taps.far[i] = weight_of(far * length);
        if (top) continue;
        // Between the last node and the face, where nothing is left, optical depth falls to 0.
        double above = beside(1);
        for (int k = 0; k < 2; ++k)
            if (rim[k]) above *= std::max(0.0, 1 - 2 * slope[k]);
        taps.above[i] = float(above);
    }
    return taps;
}

int floor_of(double v) {
    const int whole = int(v);
    return double(whole) > v ? whole - 1 : whole;
}
int wrapped(int v, int n) { return ((v % n) + n) % n; }

/// Weights by their places, summed in double, in an order of their own.
using TapMap = std::map<std::tuple<int, int, int>, double>;

std::vector<SweepTap> tap_list(const TapMap& map) {
    std::vector<SweepTap> list;
    for (const auto& [place, weight] : map)
        if (weight > 0)
            list.push_back(
                {std::get<2>(place), std::get<1>(place), std::get<0>(place), weight_of(weight)});
    return list;
}

/// Where the ray over [0, end] slices crosses lines of voxel centres, ends included, rising; or
/// their faces, `shift` half a voxel before.
std::vector<double> crossings(const double (&slope)[2], double end, double shift) {
    std::vector<double> at{0, end};
    for (double s : slope)
        for (int n = 1; magnitude(s) > 0 && n - shift < magnitude(s) * end; ++n)
            at.push_back((n - shift) / magnitude(s));
    std::sort(at.begin(), at.end());
    return at;
}

void add_densities(const Grid& grid, const double (&slope)[2], bool top, double length,
                   TapMap& map) {
    std::vector<double> at = crossings(slope, top ? 0.5 : 1, grid.constant ? 0.5 : 0);
    if (grid.constant && !top) {
        at.push_back(0.5);
        std::sort(at.begin(), at.end());
    }
    for (std::size_t p = 0; p + 1 < at.size(); ++p) {
        const double middle = 0.5 * (at[p] + at[p + 1]);
        if (grid.constant) {
            const int x = floor_of(middle * slope[0] + 0.5), y = floor_of(middle * slope[1] + 0.5);
            map[{middle > 0.5 ? 1 : 2, wrapped(y, grid.size[1]), wrapped(x, grid.size[0])}] +=
                length * (at[p + 1] - at[p]);
            continue;
        }
        const int x0 = floor_of(middle * slope[0]), y0 = floor_of(middle * slope[1]);
        for (int i = 0; i < 8; ++i) {
            const int u = i & 1, v = (i >> 1) & 1, far = i >> 2;
            const auto weight = [&](double t) {
                const double x = t * slope[0] - x0, y = t * slope[1] - y0;
                return share(u, 1, false, x) * share(v, 1, false, y) * share(far, 1, top, t);
            };
            map[{far != 0 ? 1 : 2, wrapped(y0 + v, grid.size[1]), wrapped(x0 + u, grid.size[0])}] +=
                length * simpson(at[p], at[p + 1], weight);
        }
    }
}

}  // namespace

SweepParams sweep_params(const Grid& grid, const std::array<float, 3>& to_sun,
                         double extinction_per_m, int threads) {
    const std::array<double, 3> d = in_voxels(grid, to_sun);
    SweepParams k{};
    k.axis = 2;
    for (int a = 1; a >= 0; --a)
        if (magnitude(d[std::size_t(a)]) > magnitude(d[std::size_t(k.axis)])) k.axis = a;
    double slope[2] = {};
    const double along = magnitude(d[std::size_t(k.axis)]);
    for (int a = 0, lesser = 0; a < 3; ++a) {
        k.size[a] = grid.size[a];
        k.step[a] = d[std::size_t(a)] < 0 ? -1 : 1;
        if (a != k.axis) slope[lesser++] = magnitude(d[std::size_t(a)]) / along;
    }
    // Blocks of a diagonal run at once and wait for one another behind it: with four times as many
    // along an edge as threads an eighth of the time is lost, and the waits are few.
    for (int i = 0; i < 2; ++i) {
        const int rows = grid.size[i + 1] / (4 * threads);
        k.edge[i] = rows < kSweepRows ? kSweepRows : rows / kSweepRows * kSweepRows;
        k.blocks[i] = (grid.size[i + 1] + k.edge[i] - 1) / k.edge[i];
    }
    for (int i = 0; i < 8; ++i)
        k.taps[i] = open_taps(slope, {(i & kSweepRimU) != 0, (i & kSweepRimV) != 0},
                              (i & kSweepTop) != 0, grid.constant, extinction_per_m / along);
    return k;
}

bool layer_taps(const Grid& grid, const std::array<float, 3>& to_sun, double extinction_per_m,
                std::vector<SweepTap>& inner, std::vector<SweepTap>& top) {
    const std::array<double, 3> d = in_voxels(grid, to_sun);
    const double along = magnitude(d[2]);
    if (magnitude(d[0]) + magnitude(d[1]) > kMaxShift * along) return false;
    const double slope[2] = {d[0] / along, d[1] / along};
    TapMap below, first;
    add_densities(grid, slope, false, extinction_per_m / along, below);
    add_densities(grid, slope, true, extinction_per_m / along, first);
    const int x0 = floor_of(slope[0]), y0 = floor_of(slope[1]);
    for (int i = 0; i < 4; ++i)
        below[{0, wrapped(y0 + i / 2, grid.size[1]), wrapped(x0 + (i & 1), grid.size[0])}] +=
            share(i & 1, 1, false, slope[0] - x0) * share(i / 2, 1, false, slope[1] - y0);
    inner = tap_list(below);
    top = tap_list(first);
    return true;
}

}  // namespace pileus
