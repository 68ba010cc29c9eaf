// SPDX-License-Identifier: Apache-2.0
// What a lane of the path tracer knows, how it collects light, and how a flight begins.
// in: vertices and directions -> out: walkers in the grid; sums of radiance.
// docs/path.md: a path and its shadow rays take turns in one lane.
#pragma once
#include "kernels_cpu/light/lamp.h"
#include "kernels_cpu/media/flight.h"
#include "kernels_cpu/path/path_needs.h"
#include "kernels_cpu/solids/solids.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What a lane is flying for.
constexpr std::int32_t kFlightPath = 0;  ///< the path's next vertex
constexpr std::int32_t kFlightSun = 1;   ///< a shadow ray towards the sun
constexpr std::int32_t kFlightMap = 2;   ///< a shadow ray towards a point of the sky map
constexpr std::int32_t kFlightNear = 3;  ///< one to a lamp, from between two vertices
constexpr std::int32_t kFlightLamp = 4;  ///< one to a lamp from a vertex

/// Paths of less weight play Russian roulette: survive as twice this, with less than half a chance.
constexpr float kPathRoulette = 1.0f / 8.0f;
/// The same for a shadow ray's transmittance, which survives as about this.
constexpr float kShadowRoulette = 1.0f / 16.0f;

/// What solid thing ends each flight; nothing where K does not ask for it.
template <int W, bool Solid>
struct Walls {};
template <int W>
struct Walls<W, true> {
    F<W> wall;   // metres from where the flight begins
    I<W> piece;  // triangle, or one of the two below
};
constexpr std::int32_t kNoWall = -1;
constexpr std::int32_t kImageWall = -2;  ///< of the camera's depth image

/// What a path keeps while its branch flies (path_guide.h).
template <int W, int NC>
struct Kept {
    Vec<F<W>> vertex, next;
    F<W> beta[NC];
    F<W> odds, next_density;
    I<W> order;
    M<W> outside;
};

/// Where the sun is, and the branches that seek it; nothing where K does not ask for them.
template <int W, int NC, bool Seeks>
struct Seeker {};
template <int W, int NC>
struct Seeker<W, NC, true> {
    Vec<F<W>> to_sun;    // this path's point of the disc
    F<W> worth;          // of all that it brings; roulette knows nothing of it
    F<W> odds;           // how much likelier a branch than the path flies as this one does
    M<W> branch, forks;  // this is a branch; one is due
    Vec<F<W>> fork;      // its direction
    F<W> fork_odds;
    Kept<W, NC> main;
};

/// A ray to a lamp, and what it interrupts; nothing where K does not ask for them.
template <int W, bool Lit>
struct LampRay {};
template <int W>
struct LampRay<W, true> {
    Vec<F<W>> to_lamp;             // unit
    F<W> lamp_way;                 // metres to it
    F<W> lamp_light[3];            // what it brings at the camera, but for transmittance
    M<W> lamp_single, lamp_cloud;  // parts that it belongs to
    I<W> after;                    // from a vertex: the flight that is due then
    Vec<F<W>> near;                // where it begins between vertices, voxels
    Vec<F<W>> kept_p, kept_d;      // the path's own end
    M<W> kept_met;                 // which was a collision, else a way out
    M<W> near_done;                // the last flight has been looked at
};

/// A path per lane. A flight that has ended waits until its lane is served.
template <int W, int NC, int K>
struct PathLanes : Flight<W>,
                   Walls<W, kSolid<K>>,
                   Seeker<W, NC, kGuided<K>>,
                   LampRay<W, kLamps<K>> {
    Vec<F<W>> p;               // last tentative collision, voxels
    F<W> beta[NC];             // light at the camera per light that leaves the last vertex
    F<W> sum[3 * kPathParts];  // radiance so far
    U<W> number, event;        // of the path; its next draw
    U<W> sample;               // of the launch
    I<W> order, bounces;       // scatterings and reflections so far
    I<W> flight, medium;       // under way; met at the last collision
    F<W> seen, carry;          // shadow ray: transmittance so far is their sum
    F<W> shade;                // what the shadow ray brings per light at its end
    Vec<F<W>> vertex;          // last one: voxels; metres where it lies outside
    Vec<F<W>> next, to_map;    // directions: of the path's next flight; drawn from the map
    F<W> next_density;         // per steradian, of the path's own direction
    F<W> map_shade;            // of the flight towards the map
    M<W> mapped;               // such a flight is due
    M<W> alive, outside;       // outside: the vertex need not lie in the box
    M<W> met, lit, out;        // waiting: collision; shadow ray ended; left the box
    M<W> cloud;                // the first vertex was in the media
};

template <int W, int NC, int K>
PILEUS_FN M<W> waiting(const PathLanes<W, NC, K>& s) {
    return s.met | s.lit | s.out;
}

template <int W, int NC, int K>
PILEUS_FN void end_paths(PathLanes<W, NC, K>& s, M<W> m) {
    const M<W> keep = lnot(m);
    s.alive = s.alive & keep;
    s.met = s.met & keep;
    s.lit = s.lit & keep;
    s.out = s.out & keep;
}

/// The largest share of light that a channel of the path still carries.
template <int W, int NC, int K>
PILEUS_FN F<W> heaviest(const PathLanes<W, NC, K>& s) {
    F<W> most = s.beta[0];
    for (int c = 1; c < NC; ++c) most = max_(most, s.beta[c]);
    return most;
}

/// Unit vectors towards the sun.
template <int W, int NC, int K>
PILEUS_FN Vec<F<W>> sun_of(const PathLanes<W, NC, K>& s, const PathParams& k) {
    using T = F<W>;
    if constexpr (kGuided<K>) return s.to_sun;
    return {all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
}

/// Calls `use(optics, lanes)` for every medium that lanes of `m` have met.
template <int W, int NC, int K, class Use>
PILEUS_FN void for_media(const PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, Use use) {
    if (k.media <= 1) return use(k.optics[0], m);
    for (int i = 0; i < k.media; ++i) {
        const M<W> mine = m & (s.medium == i);
        if (any(mine)) use(k.optics[i], mine);
    }
}

/// The next 64 random bits of the lanes of `m`.
template <int W, int NC, int K>
PILEUS_FN Words<U<W>> draw(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, s.number, s.event);
    s.event = select(m, s.event + 1u, s.event);
    return w;
}

/// The 16 bits of two words that `uniform` leaves unused.
template <class UU>
PILEUS_FN UU spare_bits(const Words<UU>& w) {
    return ((w.a & 0xffu) << 8) | (w.b & 0xffu);
}

/// A chance rounded up to whole multiples of 1/`steps`: met exactly by `bits < chance * steps`
/// with random bits 0 .. steps - 1, so that what survives may be divided by it without a bias.
template <class T>
PILEUS_FN T whole_chance(T chance, float steps) {
    return min_(to_float(to_int(chance * steps) + 1) * (1.0f / steps), all<T>(1.0f));
}

/// Add `share` of `light` that the lanes of `m` found at the end of their path.
template <int W, int NC, int K>
PILEUS_FN void add_light(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, F<W> share,
                         const Vec<F<W>>& light, M<W> from_sun) {
    using T = F<W>;
    const T channel[3] = {light.x, light.y, light.z};
    const M<W> single = s.cloud & (s.order + s.bounces == 1);
    for (int c = 0; c < 3; ++c) {
        const T value = select(m, s.beta[NC == 1 ? 0 : c] * share * channel[c], T{});
        s.sum[c] = s.sum[c] + value;
        if (k.parts_wanted == 0) continue;
        const auto add = [&](PathPart part, M<W> in) {
            s.sum[3 * part + c] = s.sum[3 * part + c] + select(in, value, T{});
        };
        add(kPathSun, from_sun);
        add(kPathSingle, single);
        add(kPathCloud, s.cloud);
    }
}

/// Tentative collisions of paths in the lanes of `m`, where `density` was looked up at `corner`:
/// add what the media emit there. The mean over collisions of emission / majorant is the integral
/// of emission along the flight, times transmittance.
template <int W, int NC, int K>
PILEUS_FN void gather_emission(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, I<W> corner,
                               F<W> density) {
    using T = F<W>;
    if constexpr (kGuided<K>) m = m & lnot(s.branch);
    m = m & (density > 0.0f);
    if (!any(m)) return;
    T light[3] = {};
    const std::int64_t voxels = std::int64_t(k.grid.size[0]) * k.grid.size[1] * k.grid.size[2];
    for_shares(
        k.parts, voxels, k.media, density, [&](const float* grid) { return gather(grid, corner); },
        [&](int i, T share) {
            for (int c = 0; c < 3; ++c) light[c] = light[c] + share * k.optics[i].emission[c];
        });
    const T share = density / s.bound;
    const M<W> cloud = s.cloud | (s.order + s.bounces == 0);
    for (int c = 0; c < 3; ++c) {
        const T value = select(m, s.beta[NC == 1 ? 0 : c] * share * light[c], T{});
        s.sum[c] = s.sum[c] + value;
        if (k.parts_wanted == 0) continue;
        T& part = s.sum[3 * kPathCloud + c];
        part = part + select(cloud, value, T{});
    }
}

/// Where rays from outside enter the box, or the layer that a periodic one is, voxels; `hit` loses
/// the lanes that miss it.
template <int W>
PILEUS_FN Vec<F<W>> enter_box(const PathParams& k, const Vec<F<W>>& origin, const Vec<F<W>>& d,
                              M<W>& hit) {
    using T = F<W>;
    // A periodic medium has no sides: it is a layer, whose places repeat.
    const bool wraps = k.grid.periodic != 0;
    const Segment<T> box =
        wraps ? clip_to_layer(origin.z, d.z, k.extent[2]) : clip_to_box(origin, d, k.extent);
    hit = hit & (box.enter < box.leave);
    const auto inside = [&](T o, T along, int a) {
        T metres = o + along * box.enter;
        if (wraps && a < 2) metres = wrap_place(metres, k.extent[a]);
        return min_(max_(metres * (1.0f / k.grid.cell[a]), T{}), all<T>(float(k.grid.size[a])));
    };
    return {inside(origin.x, d.x, 0), inside(origin.y, d.y, 1), inside(origin.z, d.z, 2)};
}

/// Begin the flights of the lanes of `m` at `from`: voxels, or metres where it lies `outside`.
/// Returns the lanes that miss the box, which stay where they are.
template <int W>
PILEUS_FN M<W> send_flights(Flight<W>& w, const PathParams& k, M<W> m, const Vec<F<W>>& from,
                            M<W> outside) {
    M<W> hit = m;
    Vec<F<W>> p = from;
    if (any(m & outside)) {
        // The flight's own direction: it is never quite level in a periodic medium.
        const Vec<F<W>> entry = enter_box<W>(k, from, w.d, hit);
        hit = hit | (m & lnot(outside));
        p = {select(outside, entry.x, p.x), select(outside, entry.y, p.y),
             select(outside, entry.z, p.z)};
    }
    const F<W> middle = all<F<W>>(0.5f);
    w.cut = select(m, all<F<W>>(3e38f), w.cut);
    w.lift = select(m, F<W>{}, w.lift);
    w.wraps = select(m, I<W>{}, w.wraps);
    begin_flight(w, k.grid, hit,
                 {select(hit, p.x, middle), select(hit, p.y, middle), select(hit, p.z, middle)});
    return m & lnot(hit);
}

/// Paths that go on from the lanes of `m` survive by luck once they are light: keeps the mean,
/// saves the flights that would bring little.
template <int W, int NC, int K>
PILEUS_FN void thin_out(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    using T = F<W>;
    m = m & (s.flight == kFlightPath);
    // After the last scattering only light from behind the media is left to find, and their own.
    bool dark = !minds_solids<K>(k) && k.sky_lit == 0 && k.ground == 0;
    if constexpr (kLamps<K>) dark = dark && k.emits == 0;
    if (dark) end_paths(s, m & (s.order >= k.max_depth));
    m = m & s.alive;
    const T most = heaviest(s);
    const M<W> low = m & (most < kPathRoulette);
    if (!any(low)) return;
    const T chance = most * (0.5f / kPathRoulette);
    const M<W> survives = low & (uniform(draw(s, k, low).a) < chance);
    const T gain = 1.0f / max_(chance, all<T>(1e-30f));
    for (int c = 0; c < NC; ++c) s.beta[c] = select(survives, s.beta[c] * gain, s.beta[c]);
    end_paths(s, low & lnot(survives));
}

/// Where the last vertex lies, metres.
template <int W, int NC, int K>
PILEUS_FN Vec<F<W>> vertex_metres(const PathLanes<W, NC, K>& s, const PathParams& k) {
    const auto metres = [&](F<W> v, int a) { return select(s.outside, v, v * k.grid.cell[a]); };
    return {metres(s.vertex.x, 0), metres(s.vertex.y, 1), metres(s.vertex.z, 2)};
}

/// Metres along `d` from `o` to the ground, or as far as a float reaches.
template <int W>
PILEUS_FN F<W> way_to_ground(const PathParams& k, const Vec<F<W>>& o, const Vec<F<W>>& d) {
    const F<W> far = all<F<W>>(3e38f), height = o.z - k.ground_z;
    if (k.ground == 0) return far;
    const M<W> down = (d.z < 0.0f) & (height >= 0.0f);
    return select(down, height / max_(F<W>{} - d.z, all<F<W>>(1e-18f)), far);
}

/// Flights of the lanes of `m`, which begin at `o` metres and have been sent, end at their walls.
template <int W>
PILEUS_FN void cut_flights(Flight<W>& w, const PathParams& k, M<W> m, const Vec<F<W>>& o,
                           F<W> wall) {
    const Vec<F<W>> way{w.from.x * k.grid.cell[0] - o.x, w.from.y * k.grid.cell[1] - o.y,
                        w.from.z * k.grid.cell[2] - o.z};
    // Along the sides of a periodic medium the way in may be whole periods longer than it looks.
    const F<W> in = k.grid.periodic != 0 ? way.z / w.d.z : dot(way, w.d);
    w.cut = select(m, max_(wall - in, F<W>{}), w.cut);
    w.exit = select(m, min_(w.exit, w.cut), w.exit);
}

/// Paths of the lanes of `paths` learn what they will meet; of `rays` those behind solids are dark.
template <int W, int NC, int K>
PILEUS_FN void stop_at_solids(PathLanes<W, NC, K>& s, const PathParams& k, M<W> paths, M<W> rays) {
    using T = F<W>;
    const Vec<T> o = vertex_metres(s, k);
    if (any(rays)) {
        const M<W> dark = behind_solids(k.solids, o, s.d, all<T>(3e38f), rays);
        s.seen = select(dark, T{}, s.seen);
        s.lit = s.lit | dark;
    }
    if (!any(paths)) return;
    const SolidHit<T> hit = hit_solids(k.solids, o, s.d, way_to_ground<W>(k, o, s.d), paths);
    s.wall = select(paths, hit.distance, s.wall);
    s.piece = select(paths, hit.triangle, s.piece);
    cut_flights<W>(s, k, paths & (hit.triangle >= 0), o, hit.distance);
}

/// The rays of the lanes of `m` go to a lamp.
template <int W, int NC, int K>
PILEUS_FN void aim_at_lamp(PathLanes<W, NC, K>& s, M<W> m, const LampSight<F<W>>& sight) {
    s.to_lamp = {select(m, sight.way.x, s.to_lamp.x), select(m, sight.way.y, s.to_lamp.y),
                 select(m, sight.way.z, s.to_lamp.z)};
    s.lamp_way = select(m, sight.distance, s.lamp_way);
}

/// Send the lanes of `m`, rays to lamps; they end there.
template <int W, int NC, int K>
PILEUS_FN void launch_at_lamps(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    using T = F<W>;
    const M<W> near = s.flight == kFlightNear, outside = s.outside & lnot(near);
    const Vec<T> from{select(near, s.near.x, s.vertex.x), select(near, s.near.y, s.vertex.y),
                      select(near, s.near.z, s.vertex.z)};
    const auto metres = [&](T v, int a) { return select(outside, v, v * k.grid.cell[a]); };
    const Vec<T> o{metres(from.x, 0), metres(from.y, 1), metres(from.z, 2)};
    aim_flight(s, k.grid, m, s.to_lamp);
    const M<W> missed = send_flights<W>(s, k, m, from, outside);
    s.lit = s.lit | missed;
    cut_flights<W>(s, k, m & lnot(missed), o, s.lamp_way);
    if constexpr (kSolid<K>) {
        const M<W> dark = behind_solids(k.solids, o, s.d, s.lamp_way, m);
        s.seen = select(dark, T{}, s.seen);
        s.lit = s.lit | dark;
    }
}

/// Send the lanes of `m` from their vertex on the flight that each is due. The optical depth to go
/// is what the last flight had left, or drew where it ended: the exponential has no memory.
template <int W, int NC, int K>
PILEUS_FN void launch(PathLanes<W, NC, K>& s, const PathParams& k, PathTally& tally, M<W> m) {
    using T = F<W>;
    if constexpr (kLamps<K>) {
        const M<W> lamps = m & (s.flight >= kFlightNear);
        s.seen = select(lamps, all<T>(1.0f), s.seen);
        s.carry = select(lamps, T{}, s.carry);
        if (any(lamps)) launch_at_lamps(s, k, lamps);
        tally.shadow_rays += count_bits(bits_of(lamps));
        m = m & lnot(lamps);
        s.near_done = s.near_done & lnot(m & (s.flight == kFlightPath));
    }
    const M<W> to_sun = s.flight == kFlightSun, path = s.flight == kFlightPath;
    const Vec<T> at_sun = sun_of(s, k);
    const auto aim = [&](T sun, T map, T next) {
        return select(path, next, select(to_sun, sun, map));
    };
    aim_flight(s, k.grid, m,
               {aim(at_sun.x, s.to_map.x, s.next.x), aim(at_sun.y, s.to_map.y, s.next.y),
                aim(at_sun.z, s.to_map.z, s.next.z)});
    const M<W> missed = send_flights<W>(s, k, m, s.vertex, s.outside);
    if constexpr (kLamps<K>) s.t = select(missed, T{}, s.t);  // nothing of it lies in the box
    s.out = s.out | (missed & path);
    s.lit = s.lit | (missed & lnot(path));
    s.seen = select(m, all<T>(1.0f), s.seen);
    s.carry = select(m, T{}, s.carry);
    if constexpr (kSolid<K>) stop_at_solids(s, k, m & path, m & lnot(path));
    tally.shadow_rays += count_bits(bits_of(m & lnot(path)));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
