// SPDX-License-Identifier: Apache-2.0
// Steps along rays from block to block of a majorant grid, shared by the trackers.
// in: positions, directions, optical depths to go -> out: the next tentative collision or border.
// docs/methods.md 2, delta tracking and "Periodic media"; the walk stands on each plane it crosses:
// none is met twice.
#pragma once
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/media/medium.h"
#include "kernels_cpu/media/track_grid.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// A point under way in the grid.
template <int W>
struct Walker {
    Vec<F<W>> p, d, inverse;  // voxels; unit; metres per voxel plane along each axis
    F<W> lift;                // what rounding took from p.z, voxels; periodic grids only
    F<W> tau;                 // optical depth to go
    I<W> block_x, block_y, block_z;
};

/// Metres along `d` per metre of axis; a direction with no extent never reaches a plane.
template <class T>
PILEUS_FN T safe_inverse(T d) {
    return 1.0f / copysign_(max_(abs_(d), all<T>(1e-18f)), d);
}

/// Least |d.z| in a periodic grid, 0.0009 degrees: a level ray would fly on for ever through empty
/// air, so that it is tilted by this much. It leaves a layer within 65536 times its height.
constexpr float kMinSlope = 0x1p-16f;

template <int W>
PILEUS_FN void set_direction(Walker<W>& s, const TrackGrid& k, M<W> m, Vec<F<W>> d) {
    if (k.periodic != 0) d.z = copysign_(max_(abs_(d.z), all<F<W>>(kMinSlope)), d.z);
    s.d.x = select(m, d.x, s.d.x);
    s.d.y = select(m, d.y, s.d.y);
    s.d.z = select(m, d.z, s.d.z);
    s.inverse.x = select(m, k.cell[0] * safe_inverse(d.x), s.inverse.x);
    s.inverse.y = select(m, k.cell[1] * safe_inverse(d.y), s.inverse.y);
    s.inverse.z = select(m, k.cell[2] * safe_inverse(d.z), s.inverse.z);
}

/// Block of a position that lies on or in the box.
template <class T>
PILEUS_FN auto block_of(T p, const TrackGrid& k, int axis) {
    const auto i = to_int(p * (1.0f / k.block));
    const auto last = all<I_of<T>>(k.blocks[axis] - 1);
    return min_(max_(i, I_of<T>{}), last);
}

template <int W>
PILEUS_FN void set_position(Walker<W>& s, const TrackGrid& k, M<W> m, Vec<F<W>> p) {
    s.lift = select(m, F<W>{}, s.lift);
    s.p.x = select(m, p.x, s.p.x);
    s.p.y = select(m, p.y, s.p.y);
    s.p.z = select(m, p.z, s.p.z);
    s.block_x = select(m, block_of(p.x, k, 0), s.block_x);
    s.block_y = select(m, block_of(p.y, k, 1), s.block_y);
    s.block_z = select(m, block_of(p.z, k, 2), s.block_z);
}

/// Exponential free flight, exact in its tail: the 2^-24 share of draws beyond 16.6 optical
/// depths is continued with 40 more bits, up to 44 (docs/testing.md S52).
template <class UU>
PILEUS_FN auto free_flight(UU word, UU more) {
    using T = F_of<UU>;
    const UU k = word >> 8;
    const auto tail = k == 0u;
    const T u = select(tail, all<T>(1.0f), to_float(reinterpret<I_of<UU>>(k)) * 0x1p-24f);
    T tau = T{} - log_(u);
    if (any(tail)) {
        const T fine = to_float(reinterpret<I_of<UU>>(more >> 8)) * 0x1p-24f;
        const T v = (to_float(reinterpret<I_of<UU>>(word & 255u)) + fine) * 0x1p-8f + 0x1p-40f;
        tau = select(tail, 16.6355323f - log_(v), tau);
    }
    return tau;
}

/// Optical depth to the next collision after one that was refused: the draw `u` of the `word` was
/// not below the share `real` of real collisions, and is even above it still. Its 32 bits are
/// continued where they end: `more()` is called for 2^-24 of all draws.
template <class UU, class More>
PILEUS_FN auto next_flight(UU word, F_of<UU> real, M_of<UU> refused, More more) {
    using T = F_of<UU>;
    const T low = to_float(reinterpret<I_of<UU>>(word & 255u));
    T above = (1.0f - uniform(word)) - (low * 0x1p-32f + 0x1p-33f);
    const auto tail = refused & (word >= 0xffffff00u);
    if (any(tail)) {
        const T fine = uniform(more());
        above = select(tail, ((255.0f - low) + fine) * 0x1p-32f + 0x1p-64f, above);
    }
    // Never 0, as no free flight is.
    return max_(T{} - log_(select(refused, above / (1.0f - real), all<T>(1.0f))), all<T>(0x1p-25f));
}

/// The voxel that holds a position in or on the box.
template <class T>
PILEUS_FN auto voxel_of(const Vec<T>& p, const TrackGrid& k) {
    using II = I_of<T>;
    const auto clamped = [](T at, std::int32_t n) {
        return min_(max_(to_int(at), II{}), all<II>(n - 1));
    };
    return (clamped(p.z, k.size[2]) * k.size[1] + clamped(p.y, k.size[1])) * k.size[0] +
           clamped(p.x, k.size[0]);
}

/// Index of one of the eight voxels around `p`, drawn with its trilinear weight: to 11 bits in x
/// and y, 10 in z, rounded without a systematic error; the bits of one word serve once. Where a
/// voxel has one density, the voxel itself.
template <class T, class UU>
PILEUS_FN auto corner_voxel(const Vec<T>& p, UU bits, const TrackGrid& k) {
    using II = I_of<T>;
    if (k.constant != 0) return voxel_of(p, k);
    const auto draw = [](T at, UU word, float step, std::int32_t n, bool wraps) {
        const T jitter = to_float(reinterpret<II>(word)) * step + (0.5f * step - 0.5f);
        const II last = all<II>(n - 1);
        if (!wraps) return min_(to_int(max_(at + jitter, T{})), last);
        // Beyond the first voxel lies the last one of the period before, and the other way round.
        const II i = floor_int(at + jitter);
        return select(i < 0, last, select(i > last, II{}, i));
    };
    const bool wraps = k.periodic != 0;
    const II x = draw(p.x, bits & 0x7ffu, 0x1p-11f, k.size[0], wraps);
    const II y = draw(p.y, (bits >> 11) & 0x7ffu, 0x1p-11f, k.size[1], wraps);
    const II z = draw(p.z, (bits >> 22), 0x1p-10f, k.size[2], false);
    return (z * k.size[1] + y) * k.size[0] + x;
}

/// The end of a way through one block, or over several empty ones.
template <int W>
struct BlockEnd {
    M<W> hops;             // lanes that stand there
    F<W> sigma_t, border;  // 1/m; metres gone to the nearest plane
    I<W> reach;            // blocks on all sides that are empty like this one
    F<W> tx, ty;           // metres to the planes ahead
    Vec<F<W>> plane;       // where they lie, voxels
};

/// Move the lanes of `active` straight on.
template <int W>
PILEUS_FN void move(Walker<W>& s, const TrackGrid& k, M<W> active, F<W> metres) {
    using T = F<W>;
    s.p.x = select(active, s.p.x + s.d.x * metres * (1.0f / k.cell[0]), s.p.x);
    s.p.y = select(active, s.p.y + s.d.y * metres * (1.0f / k.cell[1]), s.p.y);
    const T rise = s.d.z * metres * (1.0f / k.cell[2]);
    if (k.periodic != 0) {
        // A grazing ray makes many short strides: carry what rounding takes of its climb.
        const T climb = rise + s.lift, z = s.p.z + climb;
        s.lift = select(active, climb - (z - s.p.z), s.lift);
        s.p.z = select(active, z, s.p.z);
    } else {
        s.p.z = select(active, s.p.z + rise, s.p.z);
    }
}

/// Which lanes left the box, and which crossed a plane across z.
template <int W>
struct Crossing {
    M<W> out, by_z;
};

/// Lanes that left the grid along one axis of a periodic one enter it again on the far face.
template <int W>
PILEUS_FN void wrap(I<W>& block, F<W>& p, std::int32_t blocks, std::int32_t size) {
    const M<W> below = block < 0, above = block >= blocks;
    p = select(below, all<F<W>>(float(size)), select(above, F<W>{}, p));
    block = select(below, all<I<W>>(blocks - 1), select(above, I<W>{}, block));
}

/// Put the lanes that hop into the next block, exactly on the plane they cross. A periodic grid is
/// left through its top and bottom only. The planes may lie m.reach blocks farther on.
template <int W>
PILEUS_FN Crossing<W> cross(Walker<W>& s, const TrackGrid& k, const BlockEnd<W>& m) {
    using T = F<W>;
    s.tau = select(m.hops, max_(s.tau - m.sigma_t * m.border, T{}), s.tau);
    const M<W> by_x = m.hops & (m.tx <= m.border);
    const M<W> by_y = m.hops & lnot(by_x) & (m.ty <= m.border);
    const M<W> by_z = m.hops & lnot(by_x | by_y);
    const I<W> step = m.reach + 1;
    const auto turn = [&](I<W> i, M<W> by, T inverse) {
        return select(by, select(inverse > 0.0f, i + step, i - step), i);
    };
    s.p.x = select(by_x, m.plane.x, s.p.x);
    s.p.y = select(by_y, m.plane.y, s.p.y);
    s.p.z = select(by_z, m.plane.z, s.p.z);
    s.block_x = turn(s.block_x, by_x, s.inverse.x);
    s.block_y = turn(s.block_y, by_y, s.inverse.y);
    s.block_z = turn(s.block_z, by_z, s.inverse.z);
    // A leap may pass the sides of the block on its way: look where it ends.
    const M<W> far = m.hops & (m.reach > 0);
    if (any(far)) {
        s.block_x = select(far & lnot(by_x), block_of(s.p.x, k, 0), s.block_x);
        s.block_y = select(far & lnot(by_y), block_of(s.p.y, k, 1), s.block_y);
        s.block_z = select(far & lnot(by_z), block_of(s.p.z, k, 2), s.block_z);
    }
    if (k.periodic != 0) {
        s.lift = select(by_z, T{}, s.lift);
        wrap<W>(s.block_x, s.p.x, k.blocks[0], k.size[0]);
        wrap<W>(s.block_y, s.p.y, k.blocks[1], k.size[1]);
    }
    const auto outside = [](I<W> i, std::int32_t n) { return (i < 0) | (i >= n); };
    const M<W> out = m.hops & (outside(s.block_x, k.blocks[0]) | outside(s.block_y, k.blocks[1]) |
                               outside(s.block_z, k.blocks[2]));
    return {out, by_z};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
