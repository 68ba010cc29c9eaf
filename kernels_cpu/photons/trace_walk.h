// SPDX-License-Identifier: Apache-2.0
// A photon's way through one block of the majorant grid, measured when it enters the block.
// in: photons, their optical depths to go -> out: the next tentative collision or the next block.
// docs/methods.md 2, "Delta tracking"; collisions that are refused cost no geometry.
// Empty blocks know how many lie around them, and all of these are left in one leap.
#pragma once
#include "kernels_cpu/photons/trace_start.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Where the block that a lane stands in ends along one axis, in its direction: voxels.
template <int W>
PILEUS_FN F<W> plane_ahead(I<W> block, I<W> reach, F<W> inverse, float edge, std::int32_t n) {
    const I<W> ahead = select(inverse > 0.0f, block + reach + 1, block - reach);
    return max_(min_(to_float(ahead) * edge, all<F<W>>(float(n))), F<W>{});
}
template <int W>
PILEUS_FN Vec<F<W>> planes_ahead(const Walker<W>& s, const TrackGrid& k, I<W> reach) {
    return {plane_ahead<W>(s.block_x, reach, s.inverse.x, k.block, k.size[0]),
            plane_ahead<W>(s.block_y, reach, s.inverse.y, k.block, k.size[1]),
            plane_ahead<W>(s.block_z, reach, s.inverse.z, k.block, k.size[2])};
}

/// Look up the blocks that the lanes of `m` stand in, and measure the way to where they leave them.
template <int W, int NC, bool S>
PILEUS_FN void enter(Photon<W, NC, S>& s, const TrackGrid& k, M<W> m) {
    using T = F<W>;
    const I<W> block = (s.block_z * k.blocks[1] + s.block_y) * k.blocks[0] + s.block_x;
    const T majorant = gather(k.majorant, select(m, block, I<W>{}));
    const I<W> reach = to_int(max_(T{} - majorant, T{}));
    const Vec<T> plane = planes_ahead(s, k, reach);
    const T tx = max_((plane.x - s.p.x) * s.inverse.x, T{});
    const T ty = max_((plane.y - s.p.y) * s.inverse.y, T{});
    const T tz = max_((plane.z - s.p.z) * s.inverse.z, T{});
    const T room = min_(min_(tx, ty), tz);
    const I<W> exit = select(tx <= room, I<W>{}, select(ty <= room, all<I<W>>(1), all<I<W>>(2)));
    s.bound = select(m, max_(majorant, T{}), s.bound);
    s.reach = select(m, reach, s.reach);
    s.room = select(m, room, s.room);
    s.exit = select(m, exit, s.exit);
    s.enters = select(m, I<W>{}, s.enters);
}

/// Put the lanes of `hops`, which stand at the end of their block, into the next one, exactly on
/// the plane between the two.
template <int W, int NC, bool S>
PILEUS_FN Crossing<W> hop(Photon<W, NC, S>& s, const TrackGrid& k, M<W> hops) {
    using T = F<W>;
    BlockEnd<W> m;
    m.hops = hops;
    m.sigma_t = s.bound * k.sigma;
    m.border = s.room;
    m.reach = s.reach;
    m.tx = select(s.exit == 0, T{}, all<T>(3e38f));
    m.ty = select(s.exit == 1, T{}, all<T>(3e38f));
    m.plane = planes_ahead(s, k, s.reach);
    s.enters = select(hops, all<I<W>>(-1), s.enters);
    return cross(s, k, m);
}

/// Move the lanes of `active` to their next tentative collision, or as far as the end of their
/// block: returns those that come to a collision.
template <int W, int NC, bool S>
PILEUS_FN M<W> fly(Photon<W, NC, S>& s, const TrackGrid& k, M<W> active) {
    using T = F<W>;
    const auto fresh = active & (s.enters != 0);
    if (any(fresh)) enter(s, k, fresh);
    const T flight = s.tau / (s.bound * k.sigma);
    auto hits = active & (flight < s.room);
    T metres = select(hits, flight, s.room);
    if constexpr (S) {
        s.stopped = active & (s.wall <= metres);
        hits = hits & lnot(s.stopped);
        metres = min_(metres, s.wall);
        s.wall = select(active, s.wall - metres, s.wall);
    }
    move(s, k, active, metres);
    s.room = select(hits, s.room - flight, s.room);
    s.path = s.path + select(active, metres, T{});
    return hits;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
