// SPDX-License-Identifier: Apache-2.0
// See outline.h.
#include "lab/statistics/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pileus {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A piece of contour in one square of four middles, and the corner on its inner side.
struct Piece {
    double length;
    int corner;
};

double between(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/// Corners 0 to 3: (0,0), (1,0), (1,1), (0,1). At most two pieces; returns how many.
int pieces_of(const std::array<double, 4>& v, double level, Piece* out) {
    constexpr double kX[] = {0, 1, 1, 0}, kY[] = {0, 0, 1, 1};
    int inside = 0;
    for (int i = 0; i < 4; ++i) inside |= v[std::size_t(i)] > level ? 1 << i : 0;
    if (inside == 0 || inside == 15) return 0;
    // Where the contour crosses the edge from corner i to the next one.
    const auto cross = [&](int i) {
        const int j = (i + 1) & 3;
        const double a = v[std::size_t(i)], b = v[std::size_t(j)], t = (level - a) / (b - a);
        return std::array<double, 2>{kX[i] + t * (kX[j] - kX[i]), kY[i] + t * (kY[j] - kY[i])};
    };
    const bool saddle = inside == 5 || inside == 10;
    if (!saddle) {
        std::array<double, 2> ends[2];
        int n = 0, corner = 0;
        for (int i = 0; i < 4; ++i) {
            const bool here = (inside >> i & 1) != 0, next = (inside >> ((i + 1) & 3) & 1) != 0;
            if (here) corner = i;
            if (here != next) ends[n++] = cross(i);
        }
        out[0] = {between(ends[0], ends[1]), corner};
        return 1;
    }
    // Each corner inside is cut off by itself.
    int n = 0;
    for (int i = 0; i < 4; ++i)
        if ((inside >> i & 1) != 0) out[n++] = {between(cross(i), cross((i + 3) & 3)), i};
    return n;
}

template <class Visit>
void for_each_piece(const Plane& p, double level, Visit visit) {
    constexpr int kX[] = {0, 1, 1, 0}, kY[] = {0, 0, 1, 1};
    for (int y = -1; y < p.ny; ++y)
        for (int x = -1; x < p.nx; ++x) {
            Piece pieces[2];
            const std::array<double, 4> v{p.at(x, y), p.at(x + 1, y), p.at(x + 1, y + 1),
                                          p.at(x, y + 1)};
            const int n = pieces_of(v, level, pieces);
            for (int i = 0; i < n; ++i)
                visit(pieces[i].length, x + kX[pieces[i].corner], y + kY[pieces[i].corner]);
        }
}

}  // namespace

double contour_length(const Plane& plane, double level) {
    double sum = 0;
    for_each_piece(plane, level, [&](double length, int, int) { sum += length; });
    return sum;
}

Plane block_means(const Plane& plane, int b, int x, int y) {
    Plane out((plane.nx + x + b - 1) / b, (plane.ny + y + b - 1) / b);
    for (int j = 0; j < plane.ny; ++j)
        for (int i = 0; i < plane.nx; ++i)
            out.cell((i + x) / b, (j + y) / b) += plane.at(i, j) / (b * b);
    return out;
}

double fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
    if (x.size() < 2) return kNone;
    double mx = 0, my = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) mx += x[i], my += y[i];
    mx /= double(x.size()), my /= double(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
    return xx > 0 ? xy / xx : kNone;
}

double outline_dimension(const Plane& plane, double threshold) {
    Plane capped = plane;
    for (double& v : capped.value) v = std::min(v / threshold, 4.0);
    std::vector<double> size, length;
    for (int b = 1; b <= 8; b *= 2) {
        // Where blocks begin is chance: a mean over two places along each axis.
        double sum = 0;
        for (int i = 0; i < 4; ++i)
            sum += contour_length(block_means(capped, b, (i & 1) * b / 2, (i >> 1) * b / 2), 1) * b;
        if (!(sum > 0)) return kNone;
        size.push_back(std::log(double(b))), length.push_back(std::log(sum / 4));
    }
    return 1 - fitted_slope(size, length);
}

std::vector<Patch> patches(const Plane& plane, double threshold) {
    // Cells of a patch share a number; those that reach the rim are dropped at the end.
    std::vector<int> number(plane.value.size(), -1);
    std::vector<Patch> all;
    std::vector<bool> whole;
    std::vector<int> todo;
    const auto inside = [&](int x, int y) { return plane.at(x, y) > threshold; };
    for (int at = 0; at < plane.nx * plane.ny; ++at) {
        if (number[std::size_t(at)] >= 0 || !inside(at % plane.nx, at / plane.nx)) continue;
        const int mine = int(all.size());
        all.emplace_back(), whole.push_back(true);
        number[std::size_t(at)] = mine;
        todo.assign(1, at);
        while (!todo.empty()) {
            const int x = todo.back() % plane.nx, y = todo.back() / plane.nx;
            todo.pop_back();
            all[std::size_t(mine)].area += 1;
            constexpr int kX[] = {1, -1, 0, 0}, kY[] = {0, 0, 1, -1};
            for (int i = 0; i < 4; ++i) {
                const int u = x + kX[i], v = y + kY[i];
                if (u < 0 || v < 0 || u >= plane.nx || v >= plane.ny) {
                    whole[std::size_t(mine)] = false;
                    continue;
                }
                int& other = number[std::size_t(v * plane.nx + u)];
                if (other >= 0 || !inside(u, v)) continue;
                other = mine;
                todo.push_back(v * plane.nx + u);
            }
        }
    }
    for_each_piece(plane, threshold, [&](double length, int x, int y) {
        all[std::size_t(number[std::size_t(y * plane.nx + x)])].length += length;
    });
    std::vector<Patch> out;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (whole[i]) out.push_back(all[i]);
    return out;
}

double perimeter_area_dimension(const std::vector<Patch>& all, double least) {
    std::vector<double> area, length;
    for (const Patch& p : all)
        if (p.area >= least) area.push_back(std::log(p.area)), length.push_back(std::log(p.length));
    return area.size() < 3 ? kNone : 2 * fitted_slope(area, length);
}

}  // namespace pileus
