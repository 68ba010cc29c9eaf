// SPDX-License-Identifier: Apache-2.0
// Path tracing by importance: particles are split where much light is expected and end by luck
// where little is; what is expected stands for what luck would bring.
// in: a range of samples, light by discrete ordinates -> out: radiance per sample, without bias.
// docs/importance.md. Wagner and Haghighat 1998 (weight windows); Vorba and Krivanek 2016.
#pragma once
#include "kernels_cpu/path/importance_field.h"
#include "kernels_cpu/path/importance_lanes.h"
#include "kernels_cpu/path/path.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Groups of lanes in flight: while one waits for memory the others compute.
constexpr int kImportanceGroups = 4;

/// Lanes that wait before they are looked after: at vertices, which cost most; others. Results
/// belong to samples, so the moments are free.
template <int W>
constexpr int kVertices = W / 2 > 1 ? W / 2 + W / 8 : 1;
template <int W>
constexpr int kEnds = W / 4 > 1 ? W / 4 : 1;

/// Directions are drawn about the sun with the full chance where this much of one is left of it.
constexpr float kSunLeft = 8.0f;

/// Of shadow rays that leave the lanes of `m` and would bring `value` per irradiance leave out
/// those by luck that would bring little; those of a first vertex all fly. `spare` are 16 random
/// bits; `value` of the others is raised. Returns the lanes that fly.
template <int W>
PILEUS_FN M<W> thin_out_rays(const ImportanceLanes<W>& s, const PathParams& k, M<W> m, U<W> spare,
                             F<W>& value) {
    using T = F<W>;
    constexpr float kSteps = 0x1p16f;
    m = m & (value > 0.0f);
    const M<W> low = m & (value < k.light_roulette) & (s.order + s.bounces > 1);
    if (!any(low)) return m;
    const T chance = whole_chance(select(low, value, T{}) * (1.0f / k.light_roulette), kSteps);
    const M<W> lost = low & lnot(to_float(reinterpret<I<W>>(spare)) < chance * kSteps);
    value = select(low, value / chance, value);
    return m & lnot(lost);
}

/// Particles of the lanes of `m` have met the medium. Returns those that have a vertex there.
template <int W>
PILEUS_FN M<W> arrive(ImportanceLanes<W>& s, const PathParams& k, PathTally& tally, M<W> m,
                      Words<U<W>>& w) {
    using T = F<W>;
    const ImportanceParams& q = *k.importance;
    s.met = s.met & lnot(m);
    s.over = s.over | (m & (s.order >= k.max_depth));
    m = m & (s.order < k.max_depth);
    tally.scatterings += count_bits(bits_of(m));
    const M<W> first = m & (s.order + s.bounces == 0);
    s.cloud = s.cloud | first;
    if (q.sky_whole != 0) s.sky = select(first, all<T>(1.0f), s.sky);
    s.order = select(m, s.order + 1, s.order);
    s.outside = s.outside & lnot(m);
    const auto put3 = [&](const Vec<T>& from, Vec<T>& to) {
        to = {select(m, from.x, to.x), select(m, from.y, to.y), select(m, from.z, to.z)};
    };
    put3(s.p, s.vertex);
    put3(s.d, s.along);
    w = draw(s, k, m);
    s.node = select(m, draw_node(q.nodes, k.grid, s.vertex, w.a), s.node);
    if (q.sun_depth != nullptr)
        s.sun_depth = select(m, sun_depth_at(q, k.grid, s.vertex), s.sun_depth);
    return m;
}

/// What new vertices in the lanes of `m` are expected to bring is added, and the number of their
/// particles follows its share of the pixel's light. Returns the lanes in which one goes on; the
/// others' copies are kept.
template <int W>
PILEUS_FN M<W> weigh(ImportanceGroup<W>& g, const PathParams& k, PathTally& tally, M<W> m,
                     const LightThere<F<W>>& there, const Words<U<W>>& w) {
    using T = F<W>;
    ImportanceLanes<W>& s = g.s;
    const ImportanceParams& q = *k.importance;
    const M<W> first = m & (s.order + s.bounces == 1);
    const Expected<T> e = expected_light(k, q, there, s.sun_depth, s.along);
    const T sun = q.albedo * e.sun, sky = q.albedo * e.sky;
    const T worth = q.sun_worth * sun + q.sky_worth * sky;
    const float all_sky = q.sky_whole != 0 ? q.sky_worth : 0.0f;
    s.level = select(m & (s.level < 0.0f), max_(worth + all_sky, all<T>(q.level)), s.level);

    // As many copies as keep the weight of each in its window; one where it is near it.
    const T wanted = s.weight * (q.windows * (worth / s.level + kWindowFloor));
    const T number = min_(max_(wanted, all<T>(1e-6f)), all<T>(kMaxCopies));
    I<W> copies = floor_int(number + uniform(w.b));
    M<W> moved = m & ((number < 0.5f) | (number > 2.0f));
    const M<W> full = moved & (copies > 1) & (s.waits >= kMaxWaiting);
    if (any(full)) tally.unsplit += count_bits(bits_of(full));
    moved = moved & lnot(full & (number > 2.0f));
    copies = select(moved, copies, all<I<W>>(1));
    const T before = s.weight;
    s.weight = select(moved, s.weight / number, s.weight);

    // All copies' light that needs no luck.
    const T sent = to_float(copies) * s.weight, share = q.albedo * sent;
    const T straight = share * (e.phase * e.straight);
    s.sun = select(m, s.sun + (((before - sent) * sun + straight) + share * e.sun_around), s.sun);
    s.sky = select(m, s.sky + ((before - sent) * sky + share * e.sky_around), s.sky);
    s.single_sun = select(first, s.single_sun + straight, s.single_sun);

    s.phase = select(m, e.phase, s.phase);
    s.straight = select(m, e.straight, s.straight);
    const M<W> lives = m & (copies > 0) & (q.albedo * s.weight > 0.0f);
    s.over = s.over | (m & lnot(lives));
    const M<W> split = lives & (copies > 1);
    for (std::uint32_t lanes = bits_of(split); lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const std::int32_t left = lane(copies, i) - 1;
        tally.splits += left;
        keep_copies(g, i, left);
    }
    return lives;
}

/// As choose_lobe, with a chance in each lane.
template <class T>
PILEUS_FN LobeDraw<T> choose_turn(T chance, T u) {
    const auto first = u < chance;
    const T stretched = select(first, u / max_(chance, all<T>(0x1p-24f)),
                               (u - chance) / max_(1.0f - chance, all<T>(0x1p-24f)));
    return {first, max_(min_(stretched, all<T>(1.0f - 0x1p-24f)), all<T>(0x1p-24f))};
}

/// One particle leaves the vertex of each of the lanes of `m`: its direction, what was expected
/// from there, and its shadow ray.
template <int W>
PILEUS_FN void leave_vertex(ImportanceLanes<W>& s, const PathParams& k, M<W> m,
                            const LightThere<F<W>>& there) {
    using T = F<W>;
    const ImportanceParams& q = *k.importance;
    const PhaseParams& phase = k.optics[0].phase;
    const Words<U<W>> w = draw(s, k, m);
    // Deep in the medium nothing comes from about the sun.
    const T about_sun =
        q.sun_share * min_(kSunLeft * exp_(T{} - s.sun_depth * q.rest), all<T>(1.0f));
    const LobeDraw<T> lobe = choose_turn(1.0f - about_sun, uniform_open(w.a));
    const Vec<T> to_sun{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    const Turn<T> own = phase_sample(phase, lobe.u), about = hg_sample(all<T>(q.sun_g), lobe.u);
    const M<W> by_phase = lobe.first;
    const Turn<T> turn{select(by_phase, own.one_minus_cos, about.one_minus_cos),
                       select(by_phase, own.sine, about.sine)};
    const SinCos<T> phi = sincos_turns(uniform(w.b));
    const Vec<T> axis{select(by_phase, s.along.x, to_sun.x), select(by_phase, s.along.y, to_sun.y),
                      select(by_phase, s.along.z, to_sun.z)};
    const Vec<T> d = turned(axis, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
    T gain = all<T>(1.0f);
    if (q.sun_share > 0) {
        const T from_along = select(by_phase, own.one_minus_cos, one_minus_cosine(s.along, d));
        const T from_sun = select(by_phase, one_minus_cosine(to_sun, d), about.one_minus_cos);
        const T density = phase_density(phase, from_along);
        const T both =
            (1.0f - about_sun) * density + about_sun * hg_density(all<T>(q.sun_g), from_sun);
        gain = density / max_(both, all<T>(1e-30f));
    }
    const T each = q.albedo * s.weight, weight = each * gain;
    const Around<T> around = light_around(k, q, there, d);
    s.sun = select(m, s.sun - weight * around.sun, s.sun);
    s.sky = select(m, s.sky - weight * around.sky, s.sky);
    s.next = {select(m, d.x, s.next.x), select(m, d.y, s.next.y), select(m, d.z, s.next.z)};
    s.weight = select(m, weight, s.weight);
    s.flight = select(m, all<I<W>>(kFlightPath), s.flight);
    if (q.sun_depth == nullptr) return;
    // What the shadow ray finds besides the transmittance that is expected.
    T shade = each * s.phase;
    const M<W> flies = thin_out_rays(s, k, m, spare_bits(w), shade);
    const T known = select(flies, shade * s.straight, T{});
    s.sun = s.sun - known;
    const M<W> single = flies & s.cloud & (s.order + s.bounces == 1);
    s.single_sun = select(single, s.single_sun - known, s.single_sun);
    s.shade = select(flies, shade, s.shade);
    s.flight = select(flies, all<I<W>>(kFlightSun), s.flight);
}

/// Shadow rays of the lanes of `m` have ended.
template <int W>
PILEUS_FN void gather_light(ImportanceLanes<W>& s, M<W> m) {
    s.lit = s.lit & lnot(m);
    const F<W> light = (s.seen + s.carry) * s.shade;
    s.sun = select(m, s.sun + light, s.sun);
    const M<W> single = m & s.cloud & (s.order + s.bounces == 1);
    s.single_sun = select(single, s.single_sun + light, s.single_sun);
    s.flight = select(m, all<I<W>>(kFlightPath), s.flight);
}

/// Particles of the lanes of `m` have left the box: the ground reflects them or the sky ends them.
/// Returns the lanes that go on.
template <int W>
PILEUS_FN M<W> leave_media(ImportanceLanes<W>& s, const PathParams& k, PathTally& tally, M<W> m) {
    using T = F<W>;
    constexpr float kInvPi = 4.0f * kInvFourPi;
    s.out = s.out & lnot(m);
    M<W> ground = m & lnot(m);
    const Vec<T> o = vertex_metres(s, k);
    const T height = o.z - k.ground_z;
    if (k.ground != 0) ground = m & (s.d.z < 0.0f) & (height >= 0.0f);
    const M<W> sky = m & lnot(ground);
    // Of a sky that each path brings whole, those bring it that have met nothing.
    const M<W> adds = k.importance->sky_whole != 0 ? sky & (s.order + s.bounces == 0) : sky;
    s.sky = select(adds, s.sky + s.weight, s.sky);
    const M<W> single = sky & s.cloud & (s.order + s.bounces == 1);
    s.single_sky = select(single, s.single_sky + s.weight, s.single_sky);
    if (!any(ground) || !(k.ground_albedo > 0.0f)) return ground & lnot(ground);

    tally.bounces += count_bits(bits_of(ground));
    const T t = height / max_(T{} - s.d.z, all<T>(1e-18f));
    s.bounces = select(ground, s.bounces + 1, s.bounces);
    s.outside = s.outside | ground;
    s.vertex = {select(ground, o.x + s.d.x * t, s.vertex.x),
                select(ground, o.y + s.d.y * t, s.vertex.y),
                select(ground, all<T>(k.ground_z), s.vertex.z)};
    const Words<U<W>> w = draw(s, k, ground);
    const Lambert<T> up = lambert(w);
    s.next = {select(ground, up.a, s.next.x), select(ground, up.b, s.next.y),
              select(ground, max_(up.normal, all<T>(1e-6f)), s.next.z)};
    s.weight = select(ground, s.weight * k.ground_albedo, s.weight);
    s.flight = select(ground, all<I<W>>(kFlightPath), s.flight);
    if (k.sunlit == 0) return ground;
    T shade = s.weight * (max_(all<T>(k.to_sun[2]), T{}) * kInvPi);
    const M<W> flies = thin_out_rays(s, k, ground, spare_bits(w), shade);
    s.shade = select(flies, shade, s.shade);
    s.flight = select(flies, all<I<W>>(kFlightSun), s.flight);
    return ground;
}

/// Serve the lanes whose flights have ended, begin new samples, and send them all on.
template <int W>
PILEUS_FN void serve(ImportanceGroup<W>& g, FreshPaths<W, 0>& fresh, const PathParams& k,
                     const PathBuffers& b, bool vertices, std::uint32_t& next, std::uint32_t end) {
    constexpr std::uint32_t kFull = (1u << W) - 1u;
    ImportanceLanes<W>& s = g.s;
    PathTally& tally = *b.tally;
    const std::uint32_t before = bits_of(s.alive);
    M<W> due = s.lit;
    if (any(s.lit)) gather_light(s, s.lit);
    if (any(s.out)) {
        const M<W> out = s.out, reflected = leave_media(s, k, tally, out);
        due = due | reflected;
        s.over = s.over | (out & lnot(reflected));
    }
    // What ended waits for its sample's other particles, unless there are none.
    end_samples(s, s.over & (s.waits == 0));
    M<W> leaving = s.over & lnot(s.over);
    if (vertices) {
        leaving = s.over;
        s.over = s.over & lnot(leaving);
        if (any(leaving)) leaving = next_copies(g, leaving);
        Words<U<W>> w{};
        const M<W> met = any(s.met) ? arrive(s, k, tally, s.met, w) : s.met;
        const M<W> here = met | leaving;
        const LightThere<F<W>> there = light_there(*k.importance, select(here, s.node, I<W>{}),
                                                   select(here, s.sun_depth, F<W>{}));
        if (any(met)) leaving = leaving | weigh(g, k, tally, met, there, w);
        if (any(leaving)) leave_vertex(s, k, leaving, there);
    }
    end_samples(s, s.over & (s.waits == 0));
    due = (due | leaving) & s.alive;
    if (any(due)) launch(s, k, tally, due);
    store_samples(s, k, b, before & ~bits_of(s.alive));
    refill_samples(s, fresh, k, b, ~bits_of(s.alive) & kFull, next, end);
}

/// Tentative collisions, as collide_paths has them for one medium: particles meet it or pass,
/// shadow rays lose a share of their light.
template <int W>
PILEUS_FN void collide(ImportanceGroup<W>& g, const PathParams& k, const PathBuffers& b) {
    using T = F<W>;
    ImportanceLanes<W>& s = g.s;
    const T density = gather(k.grid.density, g.corner);
    const M<W> over = g.hits & (density > s.bound);
    if (any(over)) b.tally->majorant_violations += count_bits(bits_of(over));
    const M<W> path = g.hits & (s.flight == kFlightPath), rays = g.hits & lnot(path);
    const T luck = to_float(reinterpret<I<W>>(g.w.a & 0xffu)) * 0x1p-8f;
    T level = luck * s.bound;
    const M<W> open = path & (level < density) & ((luck + 0x1p-8f) * s.bound > density);
    const M<W> tail = g.hits & ((g.w.a >> 8) == 0u);
    Words<U<W>> more{};
    if (any(open | tail)) {
        more = threefry(k.key.k0, k.key.k1, s.number, s.event + 1u);
        level = select(open, (luck + uniform(more.a) * 0x1p-8f) * s.bound, level);
    }
    s.tau = select(g.hits, free_flight((g.w.a & 0xffffff00u) | (more.b & 0xffu), more.b), s.tau);
    s.event = select(g.hits, s.event + 2u, s.event);
    if (any(rays)) dim_rays<W>(s, rays, density, luck);
    const M<W> real = path & (level < density);
    s.met = s.met | real;
    if (any(real)) ask_for_light(*k.importance, k.grid, s.p, real);
    const M<W> tired = g.hits & (s.event >= k.grid.max_events);
    if (any(tired)) {
        b.tally->terminated += count_bits(bits_of(tired));
        end_samples(s, tired);
        store_samples(s, k, b, bits_of(tired));
    }
}

template <int W>
PILEUS_FN void trace_paths_importance(const PathParams& k, const PathBuffers& b,
                                      std::uint32_t begin, std::uint32_t end) {
    // Lanes without a sample stand at rest in the box: they are carried along by all that follows.
    const auto rest = [&](Flight<W>& f) {
        const F<W> middle = all<F<W>>(0.5f);
        f.d.z = all<F<W>>(1.0f);
        begin_flight(f, k.grid, iota<I<W>>() >= 0, {middle, middle, middle});
    };
    FreshPaths<W, 0> fresh{};
    rest(fresh.flight);
    ImportanceGroup<W> groups[kImportanceGroups] = {};
    for (ImportanceGroup<W>& g : groups) {
        rest(g.s);
        g.s.next = g.s.along = g.s.d;
    }
    std::uint32_t next = begin;
    for (bool busy = true; busy;) {
        busy = false;
        for (ImportanceGroup<W>& g : groups) {
            const ImportanceLanes<W>& s = g.s;
            const int flying = count_bits(bits_of(s.alive & lnot(waiting(s))));
            const int due = count_bits(bits_of(s.met | s.over));
            const bool vertices = due >= kVertices<W> || flying == 0;
            if (vertices || W - flying - due >= kEnds<W>)
                serve(g, fresh, k, b, vertices, next, end);
            busy |= any(g.s.alive);
            advance_paths<W>(g, k, b);
        }
        for (ImportanceGroup<W>& g : groups)
            if (any(g.hits)) collide(g, k, b);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
