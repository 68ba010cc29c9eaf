// SPDX-License-Identifier: Apache-2.0
// Where a photon begins: on the box's silhouette for a beam, on its faces for diffuse light.
// in: photon numbers -> out: position (voxels) and direction of travel.
// METHODS 3 "Shoot"; points from the R2 sequence (Roberts 2018), shifted at random.
#pragma once
#include "kernels_cpu/math.h"
#include "kernels_cpu/trace_params.h"
#include "kernels_cpu/vec.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Everything a lane knows of its photon.
template <int W, int NC>
struct Photon {
    Vec<F<W>> p, d, inverse;        // voxels; unit; metres per voxel plane along each axis
    F<W> weight[NC], tau, path;     // share left per channel; optical depth to go; metres
    U<W> index, event;
    I<W> block_x, block_y, block_z;
    I<W> order;                     // scatterings so far, bounces included
    M<W> alive, shadow, owes;       // owes: the ground below misses this photon's light
    F<W> ground_x, ground_y;        // where, metres
};

/// Metres along `d` per metre of axis; a direction with no extent never reaches a plane.
template <class T>
PILEUS_FN T safe_inverse(T d) {
    return 1.0f / copysign_(max_(abs_(d), all<T>(1e-18f)), d);
}

template <int W, int NC>
PILEUS_FN void set_direction(Photon<W, NC>& s, const TraceParams& k, M<W> m, Vec<F<W>> d) {
    s.d.x = select(m, d.x, s.d.x);
    s.d.y = select(m, d.y, s.d.y);
    s.d.z = select(m, d.z, s.d.z);
    s.inverse.x = select(m, k.cell[0] * safe_inverse(d.x), s.inverse.x);
    s.inverse.y = select(m, k.cell[1] * safe_inverse(d.y), s.inverse.y);
    s.inverse.z = select(m, k.cell[2] * safe_inverse(d.z), s.inverse.z);
}

/// Block of a position that lies on or in the box.
template <class T>
PILEUS_FN auto block_of(T p, const TraceParams& k, int axis) {
    const auto i = to_int(p * (1.0f / k.block));
    const auto last = all<I_of<T>>(k.blocks[axis] - 1);
    return min_(max_(i, I_of<T>{}), last);
}

template <int W, int NC>
PILEUS_FN void set_position(Photon<W, NC>& s, const TraceParams& k, M<W> m, Vec<F<W>> p) {
    s.p.x = select(m, p.x, s.p.x);
    s.p.y = select(m, p.y, s.p.y);
    s.p.z = select(m, p.z, s.p.z);
    s.block_x = select(m, block_of(p.x, k, 0), s.block_x);
    s.block_y = select(m, block_of(p.y, k, 1), s.block_y);
    s.block_z = select(m, block_of(p.z, k, 2), s.block_z);
}

/// Exponential free flight, exact in its tail: the 2^-24 share of draws beyond 16.6 optical
/// depths is continued with 40 more bits, up to 44 (RELIABILITY S52).
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
        if (k.hemisphere != 0)
            d.z = copysign_(d.z, all<T>(float(k.hemisphere)));
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
