// SPDX-License-Identifier: Apache-2.0
// See grid.h.
// in: two rows of cells along one axis -> out: integrals of hat functions over the target's cells.
// docs/methods.md 2, "Several media".
#include "src/world/grid/grid.h"

namespace pileus {
namespace {

constexpr double kSnap = 1e-6;  // cells; what rounding of the scene's metres may move a face by

double distance(double a, double b) { return a < b ? b - a : a - b; }

double floor_of(double x) {
    const double whole = double(std::int64_t(x));
    return whole > x ? whole - 1 : whole;
}

/// A target face in source cells: on the lattice of halves where it is meant to be, inside the row.
double face_in_source(const CellRow& target, const CellRow& source, int face) {
    const double u = (target.low_m + face * target.cell_m - source.low_m) / source.cell_m;
    if (!(u > 0)) return 0;
    if (u > source.count) return source.count;
    const double half = floor_of(2 * u + 0.5) * 0.5;
    return distance(u, half) < kSnap ? half : u;
}

/// Adds the integral of the trilinear read-out over [from, to), source cells, to `sum`, which holds
/// the cells from `begin` on. Between two centres it is linear: its middle times its length.
void integrate(double from, double to, int count, int begin, std::vector<double>& sum) {
    for (double x = from; x < to;) {
        const double centre = floor_of(x - 0.5) + 1.5;
        const double end = centre < to ? centre : to;
        double middle = 0.5 * (x + end) - 0.5;
        if (middle < 0) middle = 0;
        if (middle > count - 1) middle = count - 1;
        const int cell = int(middle);
        const double fraction = middle - cell;
        sum[std::size_t(cell - begin)] += (end - x) * (1 - fraction);
        if (fraction > 0) sum[std::size_t(cell + 1 - begin)] += (end - x) * fraction;
        x = end;
    }
}

/// The same of cells that hold one value each.
void integrate_constant(double from, double to, int begin, std::vector<double>& sum) {
    for (double x = from; x < to;) {
        const double end = floor_of(x) + 1 < to ? floor_of(x) + 1 : to;
        sum[std::size_t(int(x) - begin)] += end - x;
        x = end;
    }
}

/// Marks what is more than a copy. One source cell that fills the target's is a copy: exactly.
void settle(RowWeights& row) {
    const bool one = row.weight.size() - row.first.back() == 1;
    if (one && distance(row.weight.back(), 1) < kSnap)
        row.weight.back() = 1;
    else
        row.resampled = true;
}

/// Whole cells from the target's first face to the source's, where the two lattices coincide.
bool coincide(const CellRow& target, const CellRow& source, int& shift) {
    const double stretch = distance(source.cell_m / target.cell_m, 1) * source.count;
    const double offset = (source.low_m - target.low_m) / target.cell_m;
    shift = int(offset + 0.5);
    return stretch < kSnap && distance(offset, shift) < kSnap;
}

}  // namespace

RowWeights row_weights(const CellRow& target, const CellRow& source, bool constant) {
    RowWeights row;
    int shift = 0;
    const bool same = coincide(target, source, shift);
    std::vector<double> sum;
    for (int t = 0; t < target.count; ++t) {
        row.first.push_back(row.weight.size());
        row.begin.push_back(0);
        if (same) {
            if (t < shift || t >= shift + source.count) continue;
            row.begin.back() = t - shift;
            row.weight.push_back(1);
            continue;
        }
        const double from = face_in_source(target, source, t);
        const double to =
            t + 1 == target.count ? double(source.count) : face_in_source(target, source, t + 1);
        if (!(from < to)) continue;
        int begin = int(from - 0.5), end = int(to + 0.5) + 1;
        if (begin < 0 || from < 0.5) begin = 0;
        if (constant) begin = int(from), end = int(to) + (double(int(to)) < to ? 1 : 0);
        if (end > source.count) end = source.count;
        sum.assign(std::size_t(end - begin), 0.0);
        if (constant)
            integrate_constant(from, to, begin, sum);
        else
            integrate(from, to, source.count, begin, sum);
        row.begin.back() = begin;
        for (double w : sum) row.weight.push_back(w * source.cell_m / target.cell_m);
        settle(row);
    }
    row.first.push_back(row.weight.size());
    return row;
}

}  // namespace pileus
