// SPDX-License-Identifier: Apache-2.0
// Where a photon begins: on the box's silhouette for a beam, on its faces for diffuse light.
// in: photon numbers -> out: position (voxels) and direction of travel.
// docs/methods.md 3 "Shoot"; points from the R2 sequence (Roberts 2018), shifted at random.
#pragma once
#include "kernels_cpu/trace_params.h"
#include "kernels_cpu/walk.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Everything a lane knows of its photon.
template <int W, int NC>
struct Photon : Walker<W> {
    F<W> weight[NC], path;  // share left per channel; metres
    U<W> index, event;
    I<W> order;                // scatterings so far, bounces included
    M<W> alive, shadow, owes;  // owes: the ground below misses this photon's light
    F<W> owed_x, owed_y;       // where on the ground, metres
    F<W> ground_x, ground_y;   // where on the ground the next bounce starts, metres
};

/// Cosine-weighted direction: height over the plane and the two components in it.
template <class T>
struct Lambert {
    T normal, a, b;
};
template <class UU>
PILEUS_FN auto lambert(Words<UU> w) {
    using T = F_of<UU>;
    const T u = uniform(w.a);
    const SinCos<T> turn = sincos_turns(uniform(w.b));
    const T sine = sqrt_(u);
    return Lambert<T>{sqrt_(1.0f - u), sine * turn.cosine, sine * turn.sine};
}

/// Begin photons `s.index` (numbered within the launch) in the lanes of `m`.
template <int W, int NC>
PILEUS_FN void start_photons(Photon<W, NC>& s, const TraceParams& k, M<W> m) {
    using T = F<W>;
    const U<W> number = s.index + k.first_photon;
    T u = uniform(s.index * kR2[0] + k.shift[0]);
    const T v = uniform(s.index * kR2[1] + k.shift[1]);

    // Choose a face by its share of the flux and stretch the rest of u over it.
    I<W> face{};
    T below{}, above = all<T>(k.face_cdf[0]);
    for (int f = 0; f < 5; ++f) {
        const auto past = u >= k.face_cdf[f];
        face = select(past, all<I<W>>(f + 1), face);
        below = select(past, all<T>(k.face_cdf[f]), below);
        above = select(past, all<T>(k.face_cdf[f + 1]), above);
    }
    u = min_((u - below) / max_(above - below, all<T>(1e-12f)), all<T>(1.0f));

    const I<W> axis = face >> 1;
    const auto on_x = axis == 0, on_y = axis == 1, high = (face & 1) != 0;
    const T nx = all<T>(float(k.size[0])), ny = all<T>(float(k.size[1])),
            nz = all<T>(float(k.size[2]));
    const T zero{};
    const Vec<T> p{select(on_x, select(high, nx, zero), u * nx),
                   select(on_y, select(high, ny, zero), select(on_x, u * ny, v * ny)),
                   select(on_x, v * nz, select(on_y, v * nz, select(high, nz, zero)))};

    Vec<T> d{all<T>(k.direction[0]), all<T>(k.direction[1]), all<T>(k.direction[2])};
    if (k.light == kLightDiffuse) {
        const Lambert<T> l = lambert(threefry(k.key.k0, k.key.k1, number, U<W>{}));
        const T n = select(high, T{} - l.normal, l.normal);
        d = {select(on_x, n, l.a), select(on_y, n, select(on_x, l.a, l.b)),
             select(on_x, l.b, select(on_y, l.b, n))};
        // A side face sees half of a hemisphere of sky: mirror the other half into it.
        if (k.hemisphere != 0) d.z = copysign_(d.z, all<T>(float(k.hemisphere)));
    }
    set_position(s, k, m, p);
    set_direction(s, k, m, d);

    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, number, all<U<W>>(1u));
    s.tau = select(m, free_flight(w.a, w.b), s.tau);
    for (int c = 0; c < NC; ++c) s.weight[c] = select(m, all<T>(1.0f), s.weight[c]);
    s.path = select(m, zero, s.path);
    s.event = select(m, U<W>{}, s.event);
    s.order = select(m, I<W>{}, s.order);
    s.alive = s.alive | m;
    s.shadow = s.shadow & lnot(m);
    s.owes = s.owes & lnot(m);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
