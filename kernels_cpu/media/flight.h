// SPDX-License-Identifier: Apache-2.0
// Straight flights through a grid of majorants, in cheap steps and with leaps through empty air.
// in: places, directions, optical depths to go -> out: tentative collisions, ways out of the box.
// docs/path.md, "Flight". After Amanatides and Woo 1987: the planes ahead are told by their
// distances from where the flight began, so that a step is a few additions.
#pragma once
#include "kernels_cpu/media/walk.h"

namespace pileus {

/// Bound of the ring of blocks around the grid (src/methods/path/path_blocks.h).
constexpr float kBoundOut = -0x1p20f;

/// Least |component| of a direction that counts; safe_inverse holds on to the same.
constexpr float kMinAlong = 1e-18f;

inline namespace PILEUS_ISA {

/// A ray under way: it stands `t` metres from where it began.
template <int W>
struct Flight {
    Vec<F<W>> from, speed, d;  // voxels; voxels per metre; unit
    Vec<F<W>> plane, gap;      // metres: to the next planes from the beginning, between planes
    F<W> t, exit;              // metres; where the grid ends
    F<W> cut;                  // metres from where it began to what ends it within the grid
    F<W> tau;                  // optical depth to go
    F<W> bound;                // of the block: majorant, or minus the blocks a leap clears
    F<W> lift;                 // what rounding took from the height, voxels; periodic grids only
    I<W> wraps;                // times that it left a side of a periodic grid
    I<W> block;                // in the grid with its ring
};

/// Along an axis that a direction does not really follow it is +0: its speed, the planes ahead and
/// the way out are told by one sign, which rounding to -0 would take from some of them.
template <class T>
PILEUS_FN T one_zero(T d) {
    return select(abs_(d) < kMinAlong, T{}, d);
}

/// Point the lanes of `m` along `d`.
template <int W>
PILEUS_FN void aim_flight(Flight<W>& s, const TrackGrid& k, M<W> m, Vec<F<W>> d) {
    d = {one_zero(d.x), one_zero(d.y), one_zero(d.z)};
    if (k.periodic != 0) d.z = copysign_(max_(abs_(d.z), all<F<W>>(kMinSlope)), d.z);
    s.d = {select(m, d.x, s.d.x), select(m, d.y, s.d.y), select(m, d.z, s.d.z)};
}

/// Step between neighbouring blocks along an axis of the grid with its ring.
PILEUS_FN std::int32_t block_step(const TrackGrid& k, int axis) {
    const std::int32_t row = k.blocks[0] + 2;
    return axis == 0 ? 1 : axis == 1 ? row : row * (k.blocks[1] + 2);
}

/// Metres from `at` to the face of the grid that a ray meets, which makes `inverse` metres a voxel.
template <class T>
PILEUS_FN T face_ahead(T at, T inverse, const TrackGrid& k, int axis) {
    return max_((select(inverse > 0.0f, all<T>(float(k.size[axis])), T{}) - at) * inverse, T{});
}

/// Let the lanes of `m` begin at `p`, voxels, on or in the box.
template <int W>
PILEUS_FN void begin_flight(Flight<W>& s, const TrackGrid& k, M<W> m, const Vec<F<W>>& p) {
    using T = F<W>;
    I<W> block{};
    T exit = all<T>(3.0e38f);
    const auto along = [&](T at, T d, int a, T& from, T& speed, T& plane, T& gap) {
        const T inverse = k.cell[a] * safe_inverse(d);
        const I<W> i = block_of(at, k, a);
        const T next = to_float(select(inverse > 0.0f, i + 1, i)) * k.block;
        exit = min_(exit, face_ahead(at, inverse, k, a));
        block = block + (i + 1) * block_step(k, a);
        from = select(m, at, from);
        speed = select(m, d * (1.0f / k.cell[a]), speed);
        plane = select(m, max_((next - at) * inverse, T{}), plane);
        gap = select(m, abs_(inverse) * k.block, gap);
    };
    along(p.x, s.d.x, 0, s.from.x, s.speed.x, s.plane.x, s.gap.x);
    along(p.y, s.d.y, 1, s.from.y, s.speed.y, s.plane.y, s.gap.y);
    along(p.z, s.d.z, 2, s.from.z, s.speed.z, s.plane.z, s.gap.z);
    s.t = select(m, T{}, s.t);
    s.exit = select(m, exit, s.exit);
    s.block = select(m, block, s.block);
    s.bound = select(m, gather(k.majorant, select(m, block, I<W>{})), s.bound);
}

/// Where the flights stand, voxels.
template <int W>
PILEUS_FN Vec<F<W>> place_of(const Flight<W>& s) {
    return {s.from.x + s.speed.x * s.t, s.from.y + s.speed.y * s.t, s.from.z + s.speed.z * s.t};
}

/// How often the flattest flight can leave the sides of a periodic grid before its top.
PILEUS_FN std::int32_t most_wraps(const TrackGrid& k) {
    const auto edge = [&](int a) { return float(k.size[a]) * k.cell[a]; };
    const float most = edge(2) * (1.0f / kMinSlope) * (1.0f / edge(0) + 1.0f / edge(1));
    return std::int32_t(min_(most, 0x1p30f)) + 4;
}

/// Lanes of `m` stand on a face of a periodic grid: those that left through a side go on from the
/// far one, unless they did so more often than any flight can: these are `lost`. Returns the
/// others and the lost ones, which are out.
template <int W>
PILEUS_FN M<W> wrap_flights(Flight<W>& s, const TrackGrid& k, M<W> m, M<W>& lost) {
    using T = F<W>;
    const auto ahead = [&](T at, T d, int a) {
        return face_ahead(at, k.cell[a] * safe_inverse(d), k, a);
    };
    const T x = ahead(s.from.x, s.d.x, 0), y = ahead(s.from.y, s.d.y, 1);
    const T z = ahead(s.from.z, s.d.z, 2), first = min_(x, y);
    M<W> side = m & (first < z) & (s.t < s.cut);
    if (!any(side)) return m;
    s.wraps = select(side, s.wraps + 1, s.wraps);
    lost = side & (s.wraps > most_wraps(k));
    side = side & lnot(lost);
    // Thousands of periods make as many flights: carry what rounding takes of the climb.
    const T climb = s.speed.z * s.t + s.lift;
    const T height = min_(max_(s.from.z + climb, T{}), all<T>(float(k.size[2])));
    s.lift = select(side, climb - (height - s.from.z), s.lift);
    const auto far = [&](T way, T at, T d, int a) {
        const T end = all<T>(float(k.size[a]));
        return select(way <= first, select(d < 0.0f, end, T{}), min_(max_(at, T{}), end));
    };
    const Vec<T> p = place_of(s);
    s.cut = select(side, s.cut - s.t, s.cut);
    begin_flight(s, k, side, {far(x, p.x, s.d.x, 0), far(y, p.y, s.d.y, 1), height});
    s.exit = select(side, min_(s.exit, s.cut), s.exit);
    return m & lnot(side);
}

/// What a step met: a tentative collision (hits) or a border of blocks (hops), which may be a way
/// out of the box, and of these where the flight was given up (lost).
template <int W>
struct Step {
    M<W> hits, hops, out, lost;
};

/// Enter the blocks behind `border`, metres, in the lanes of `hops`.
template <int W>
PILEUS_FN void cross_planes(Flight<W>& s, const TrackGrid& k, M<W> hops, F<W> border, F<W> reach,
                            bool leaps) {
    using T = F<W>;
    const auto along = [&](T& plane, T gap, T speed, int a) {
        const M<W> by = hops & (plane <= border);
        const std::int32_t step = block_step(k, a);
        const I<W> way = select(speed < 0.0f, all<I<W>>(-step), all<I<W>>(step));
        if (!leaps) {
            plane = select(by, plane + gap, plane);
            s.block = select(by, s.block + way, s.block);
            return;
        }
        const I<W> more = to_int(min_((border - plane) * (abs_(speed) * (1.0f / k.block)), reach));
        plane = select(by, plane + to_float(more + 1) * gap, plane);
        s.block = select(by, s.block + way * (more + 1), s.block);
    };
    along(s.plane.x, s.gap.x, s.speed.x, 0);
    along(s.plane.y, s.gap.y, s.speed.y, 1);
    along(s.plane.z, s.gap.z, s.speed.z, 2);
}

/// Move the lanes of `active` to their next tentative collision, or to the border of their block or
/// of the empty ones around it.
template <int W>
PILEUS_FN Step<W> step_flight(Flight<W>& s, const TrackGrid& k, M<W> active) {
    using T = F<W>;
    const M<W> leap = active & (s.bound < 0.0f);
    const bool leaps = any(leap);
    T reach{}, border;
    if (leaps) {
        reach = select(leap, T{} - s.bound, T{});
        border = min_(min_(s.plane.x + reach * s.gap.x, s.plane.y + reach * s.gap.y),
                      s.plane.z + reach * s.gap.z);
    } else {
        border = min_(min_(s.plane.x, s.plane.y), s.plane.z);
    }
    border = min_(border, s.exit);
    const T sigma_t = max_(s.bound, T{}) * k.sigma;
    const T depth = sigma_t * max_(border - s.t, T{});
    Step<W> m;
    m.hits = active & (s.tau < depth);
    m.hops = active & lnot(m.hits);
    m.lost = active & lnot(active);
    m.out = m.hops & lnot(border < s.exit);  // a way that is no number ends here
    s.t = select(m.hits, s.t + s.tau / sigma_t, select(m.hops, border, s.t));
    if (!any(m.hops)) return m;
    s.tau = select(m.hops, s.tau - depth, s.tau);
    cross_planes(s, k, m.hops, border, reach, leaps);
    const M<W> in = m.hops & lnot(m.out);
    s.bound = select(in, gather(k.majorant, select(in, s.block, I<W>{})), s.bound);
    m.out = m.out | (in & (s.bound <= kBoundOut));
    if (k.periodic != 0 && any(m.out)) m.out = wrap_flights(s, k, m.out, m.lost);
    return m;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
