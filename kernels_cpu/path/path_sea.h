// SPDX-License-Identifier: Apache-2.0
// Paths at a rough sea: a facet that is seen reflects them, or the water below sends them back.
// in: lanes that have met it -> out: their next direction, and the light that shadow rays bring.
// docs/ground.md, "Sea"; kernels_cpu/light/sea.h has the facets.
#pragma once
#include "kernels_cpu/light/ground.h"
#include "kernels_cpu/light/lambert.h"
#include "kernels_cpu/path/path_lamps.h"
#include "kernels_cpu/path/path_rays.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Slopes of a facet beside the waves, over the place's deviation.
template <class T>
struct SeaSlope {
    T along, across;
};

/// Of one that is seen, in the lanes of `m`.
template <int W, int NC, int K>
PILEUS_FN SeaSlope<F<W>> draw_facet(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m,
                                    const SeaSight<F<W>>& sight) {
    using T = F<W>;
    constexpr int kTries = 32;
    constexpr float kInvSqrtTwoPi = 0.398942280f;
    // A normal and a Rayleigh distribution together have more than what is seen.
    const T whole = sight.even + sight.leans * kInvSqrtTwoPi;
    SeaSlope<T> out{};
    M<W> open = m;
    for (int i = 0; i < kTries && any(open); ++i) {
        const Words<U<W>> w = draw(s, k, open), more = draw(s, k, open);
        const T radius = sqrt_(-2.0f * log_(uniform_open(w.a)));
        const SinCos<T> turn = sincos_turns(uniform(w.b));
        const M<W> even = uniform(more.a) * whole < sight.even;
        const T steep = sqrt_(-2.0f * log_(uniform_open(more.b)));
        const T x = select(even, radius * turn.cosine, steep);
        const T shown = sight.even + sight.leans * x;
        const M<W> hidden = open & even & (x < 0.0f) & lnot(uniform(more.b) * sight.even < shown);
        // Where none was taken the last counts, leaning towards the view.
        out.along = select(open, select(hidden, abs_(x), x), out.along);
        out.across = select(open, radius * turn.sine, out.across);
        open = hidden;
    }
    return out;
}

/// The lanes of `m` meet a sea at `at`, metres, whose water has `share` of the ground's albedo: a
/// facet reflects them, or what is below. Each draws one of the two, and lights by that alone.
template <int W, int NC, int K>
PILEUS_FN void reflect_at_sea(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m,
                              const Vec<F<W>>& at, const F<W> (&share)[3]) {
    using T = F<W>;
    constexpr float kInvPi = 4.0f * kInvFourPi;
    const SeaView& sea = *k.paint.sea;
    const Vec<T> from{T{} - s.d.x, T{} - s.d.y, max_(T{} - s.d.z, T{})};
    const SeaPlace<T> place = sea_place(sea, k.paint.waves, at, T{}, from.z);
    const SeaSight<T> sight = sea_sight(sea, place, from);
    const SeaSlope<T> slope = draw_facet(s, k, m, sight);
    T cosine, density;
    const Vec<T> mirrored =
        sea_mirror(place, from, slope.along * place.slope, slope.across * place.slope, cosine);
    const T reflects = water_reflects(max_(cosine, T{}));
    T water[3], most{};
    for (int c = 0; c < 3; ++c) {
        water[c] = share[c] * k.ground_albedo * (1.0f - reflects);
        most = max_(most, water[c]);
    }
    const T chance = reflects / (reflects + most);
    const Words<U<W>> luck = draw(s, k, m), w = draw(s, k, m);
    const M<W> facet = uniform(luck.a) < chance;
    const T other = 1.0f / max_(1.0f - chance, all<T>(1e-30f));
    for (int c = 0; c < NC; ++c) {
        const T weight = select(facet, reflects / chance, water[c] * other);
        s.beta[c] = select(m, s.beta[c] * weight, s.beta[c]);
    }
    const Lambert<T> up = lambert(w);
    s.next = {select(m, select(facet, mirrored.x, up.a), s.next.x),
              select(m, select(facet, mirrored.y, up.b), s.next.y),
              select(m, max_(select(facet, mirrored.z, up.normal), all<T>(1e-6f)), s.next.z)};
    // Light that goes on per irradiance for each unit of the weight, and the density of turns.
    const T unit = 1.0f / max_(reflects, all<T>(1e-30f));
    const auto value = [&](const Vec<T>& way, T& of_turns) {
        const T glint = sea_glint(place, sight.seen, from, way, of_turns) * unit;
        const T even = max_(way.z, T{}) * kInvPi;
        of_turns = select(facet, of_turns, even);
        return select(way.z > 0.0f, select(facet, glint, even), T{});
    };
    (void)value(s.next, density);
    s.next_density = select(m, density, s.next_density);
    s.shade = select(m, value(sun_of(s, k), density), s.shade);
    M<W> mapped = m & lnot(m);
    if (k.map.columns > 0) {
        const U<W> spare = aim_at_map(s, k, m);
        const T bright = value(s.to_map, density);
        mapped = map_rays(s, k, m, density, bright, spare);
    }
    if constexpr (kGuided<K>)
        seek_sun(s, k, m, [&](const Vec<T>& way, M<W>) { return max_(way.z, T{}) * kInvPi; });
    first_flight(s, k, m, mapped, spare_bits(luck));
    if constexpr (kLamps<K>)
        seek_lamps(
            s, k, m, 0, [](const Vec<T>& way) { return way.z; },
            [&](const Vec<T>& way, M<W>) { return value(way, density); });
}

}  // namespace PILEUS_ISA
}  // namespace pileus
