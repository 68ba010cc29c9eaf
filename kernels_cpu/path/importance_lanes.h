// SPDX-License-Identifier: Apache-2.0
// What a lane knows of a sample that follows importance: one particle under way, and those that
// wait until it has ended.
// in: vertices and directions -> out: flights; particles that waited; radiance that is stored.
// docs/importance.md, "How it runs": each lane follows all particles of a sample, the last first.
#pragma once
#include "kernels_cpu/path/path_start.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Vertices of one sample that may have copies waiting at a time; beyond, particles are not split.
constexpr int kMaxWaiting = 48;

/// Copies that are still to leave a vertex.
struct WaitingCopies {
    float at[3], along[3];  // the vertex, voxels; the direction in which it was met
    float weight, tau;      // of each copy; sun's optical depth
    float phase, straight;  // towards the sun: density, 1/sr; transmittance that is expected
    std::int32_t node, order, bounces, left;
};

template <int W>
struct ImportanceLanes : Flight<W> {
    Vec<F<W>> p;              // last tentative collision, voxels
    U<W> number, event;       // of the sample; its next draw
    U<W> sample;              // of the launch
    I<W> flight;              // kFlightPath or kFlightSun
    F<W> seen, carry;         // shadow ray: transmittance so far is their sum
    F<W> shade;               // what the shadow ray brings at its end
    Vec<F<W>> vertex, along;  // last one: voxels; metres where it lies outside; the way to it
    Vec<F<W>> next;           // direction of the particle's next flight
    F<W> weight, sun_depth;   // of the particle; optical depth between vertex and sun
    F<W> phase, straight;     // at the vertex, towards the sun, as WaitingCopies has them
    I<W> node, order, bounces;
    F<W> level;     // light that the pixel is reckoned to have; below 0: not known yet
    F<W> sun, sky;  // light so far, of an irradiance and of a radiance of 1
    F<W> single_sun, single_sky;
    M<W> alive, outside;       // outside: the vertex need not lie in the box
    M<W> met, lit, out, over;  // waiting: collision; shadow ray ended; left the box; ended
    M<W> cloud;                // the first vertex was in the media
    I<W> waits;                // vertices with copies that wait
};

/// Lanes, the tentative collision that each flight has come to, and the particles that wait.
template <int W>
struct ImportanceGroup {
    ImportanceLanes<W> s;
    M<W> hits;
    I<W> corner;
    Words<U<W>> w;
    WaitingCopies waiting[W][kMaxWaiting];
};

template <int W>
PILEUS_FN M<W> waiting(const ImportanceLanes<W>& s) {
    return s.met | s.lit | s.out | s.over;
}

template <int W>
PILEUS_FN void end_samples(ImportanceLanes<W>& s, M<W> m) {
    const M<W> keep = lnot(m);
    s.alive = s.alive & keep;
    s.met = s.met & keep;
    s.lit = s.lit & keep;
    s.out = s.out & keep;
    s.over = s.over & keep;
}

/// The next 64 random bits of the lanes of `m`.
template <int W>
PILEUS_FN Words<U<W>> draw(ImportanceLanes<W>& s, const PathParams& k, M<W> m) {
    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, s.number, s.event);
    s.event = select(m, s.event + 1u, s.event);
    return w;
}

/// Where the last vertex lies, metres.
template <int W>
PILEUS_FN Vec<F<W>> vertex_metres(const ImportanceLanes<W>& s, const PathParams& k) {
    const auto metres = [&](F<W> v, int a) { return select(s.outside, v, v * k.grid.cell[a]); };
    return {metres(s.vertex.x, 0), metres(s.vertex.y, 1), metres(s.vertex.z, 2)};
}

/// Copies wait in lane `i`, `left` of them.
template <int W>
PILEUS_FN void keep_copies(ImportanceGroup<W>& g, int i, std::int32_t left) {
    ImportanceLanes<W>& s = g.s;
    const std::int32_t depth = lane(s.waits, i);
    WaitingCopies& c = g.waiting[i][depth];
    c.at[0] = lane(s.vertex.x, i), c.at[1] = lane(s.vertex.y, i), c.at[2] = lane(s.vertex.z, i);
    c.along[0] = lane(s.along.x, i), c.along[1] = lane(s.along.y, i);
    c.along[2] = lane(s.along.z, i);
    c.weight = lane(s.weight, i), c.tau = lane(s.sun_depth, i);
    c.phase = lane(s.phase, i), c.straight = lane(s.straight, i);
    c.node = lane(s.node, i), c.order = lane(s.order, i), c.bounces = lane(s.bounces, i);
    c.left = left;
    set_lane(s.waits, i, depth + 1);
}

/// Particles of the lanes of `m` have ended: the next copy that waits takes their place, or the
/// sample ends. Returns the lanes with such a copy.
template <int W>
PILEUS_FN M<W> next_copies(ImportanceGroup<W>& g, M<W> m) {
    ImportanceLanes<W>& s = g.s;
    const M<W> more = m & (s.waits > 0);
    end_samples(s, m & lnot(more));
    for (std::uint32_t lanes = bits_of(more); lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const std::int32_t top = lane(s.waits, i) - 1;
        WaitingCopies& c = g.waiting[i][top];
        set_lane(s.vertex.x, i, c.at[0]), set_lane(s.vertex.y, i, c.at[1]);
        set_lane(s.vertex.z, i, c.at[2]);
        set_lane(s.along.x, i, c.along[0]), set_lane(s.along.y, i, c.along[1]);
        set_lane(s.along.z, i, c.along[2]);
        set_lane(s.weight, i, c.weight), set_lane(s.sun_depth, i, c.tau);
        set_lane(s.phase, i, c.phase), set_lane(s.straight, i, c.straight);
        set_lane(s.node, i, c.node), set_lane(s.order, i, c.order);
        set_lane(s.bounces, i, c.bounces);
        if (--c.left == 0) set_lane(s.waits, i, top);
    }
    s.outside = s.outside & lnot(more);
    return more;
}

/// Send the lanes of `m` from their vertex on the flight that each is due. The optical depth to go
/// is what the last flight had left, or drew where it ended: the exponential has no memory.
template <int W>
PILEUS_FN void launch(ImportanceLanes<W>& s, const PathParams& k, PathTally& tally, M<W> m) {
    using T = F<W>;
    const M<W> path = s.flight == kFlightPath;
    aim_flight(
        s, k.grid, m,
        {select(path, s.next.x, all<T>(k.to_sun[0])), select(path, s.next.y, all<T>(k.to_sun[1])),
         select(path, s.next.z, all<T>(k.to_sun[2]))});
    const M<W> missed = send_flights<W>(s, k, m, s.vertex, s.outside);
    s.out = s.out | (missed & path);
    s.lit = s.lit | (missed & lnot(path));
    s.seen = select(m, all<T>(1.0f), s.seen);
    s.carry = select(m, T{}, s.carry);
    tally.shadow_rays += count_bits(bits_of(m & lnot(path)));
}

/// Store the radiance of samples that have ended.
template <int W>
PILEUS_FN void store_samples(const ImportanceLanes<W>& s, const PathParams& k, const PathBuffers& b,
                             std::uint32_t lanes) {
    using T = F<W>;
    if (lanes == 0) return;
    T out[3 * kPathParts] = {};
    for (int c = 0; c < 3; ++c) {
        const T all_of_it = s.sun * k.sun[c] + s.sky * k.sky[c];
        out[3 * kPathTotal + c] = all_of_it;
        out[3 * kPathSun + c] = s.sun * k.sun[c];
        out[3 * kPathSingle + c] = s.single_sun * k.sun[c] + s.single_sky * k.sky[c];
        out[3 * kPathCloud + c] = select(s.cloud, all_of_it, T{});
    }
    store_radiance<W>(out, k.parts_wanted != 0 ? 3 * kPathParts : 3, all<T>(1.0f), s.sample, k, b,
                      lanes);
}

/// Give the lanes of `idle` the next samples.
template <int W>
PILEUS_FN void refill_samples(ImportanceLanes<W>& s, FreshPaths<W, 0>& f, const PathParams& k,
                              const PathBuffers& b, std::uint32_t idle, std::uint32_t& next,
                              std::uint32_t end) {
    using T = F<W>;
    const Refilled<W> given = hand_over_next(s, f, k, b, idle, next, end);
    const M<W>& fresh = given.fresh;
    if (!any(fresh)) return;
    s.event = select(fresh, U<W>{} + f.event, s.event);
    s.weight = select(fresh, all<T>(1.0f), s.weight);
    s.level = select(fresh, all<T>(-1.0f), s.level);
    s.sun = select(fresh, T{}, s.sun);
    s.sky = select(fresh, T{}, s.sky);
    s.single_sun = select(fresh, T{}, s.single_sun);
    s.single_sky = select(fresh, T{}, s.single_sky);
    s.order = select(fresh, I<W>{}, s.order);
    s.bounces = select(fresh, I<W>{}, s.bounces);
    s.waits = select(fresh, I<W>{}, s.waits);
    s.flight = select(fresh, all<I<W>>(kFlightPath), s.flight);
    s.alive = s.alive | fresh;
    s.outside = s.outside | fresh;
    s.cloud = s.cloud & lnot(fresh);
    s.out = s.out | given.out;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
