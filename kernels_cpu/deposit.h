// SPDX-License-Identifier: Apache-2.0
// Adds what a collision tells about the light into integer sums.
// in: direction, share and collector per lane -> out: sums[collector][channel][coefficient].
// docs/methods.md 3, repairs 2 and 3: sum_i w rho/rho_T y_i(incident) estimates the incident light.
#pragma once
#include "kernels_cpu/accumulate.h"
#include "kernels_cpu/fixed.h"
#include "kernels_cpu/sh.h"
#include "kernels_cpu/trace_start.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Adds `count` quantised values of the chosen lanes to slots [first, first + count).
template <int W>
PILEUS_FN void add_lanes(const TraceParams& k, const TraceBuffers& b, std::uint32_t lanes,
                         I<W> collector, const I<W>* quanta, int channel, int first, int count) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        const std::int64_t set = std::int64_t(lane(collector, i)) * k.channels + channel;
        std::int64_t* sums = b.sums + set * k.coefficients + first;
        add_sums(sums, quanta, i, count, b.shared_sums != 0);
    }
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

PILEUS_FN std::int64_t voxels_of(const TrackGrid& k) {
    return std::int64_t(k.size[0]) * k.size[1] * k.size[2];
}

/// What one medium, or all at `corner` by their share of the `density` there, scatter towards the
/// camera, per steradian and channel. One medium's albedo is left to the reconstruction.
template <int W, int NC>
PILEUS_FN void towards_camera(const TraceParams& k, const TraceBuffers& b, I<W> corner,
                              F<W> density, F<W> one_minus_cos, F<W> (&out)[NC]) {
    using T = F<W>;
    if (k.media <= 1) {
        out[0] = phase_density(k.optics[0].phase, one_minus_cos);
        for (int c = 1; c < NC; ++c) out[c] = out[0];
        return;
    }
    for (int c = 0; c < NC; ++c) out[c] = T{};
    for_shares(
        b.parts, voxels_of(k.grid), k.media, density,
        [&](const float* grid) { return gather(grid, corner); },
        [&](int i, T part) {
            const T p = part * phase_density(k.optics[i].phase, one_minus_cos);
            for (int c = 0; c < NC; ++c) out[c] = out[c] + p * k.optics[i].albedo[c];
        });
}

/// Deposit `share` (0..1) of each lane in `m`, travelling along s.d, into its voxel's collector.
/// Every lane's voxel must be readable, and `corner`, where the `density` was looked up.
template <int W, int NC>
PILEUS_FN void deposit(const TraceParams& k, const TraceBuffers& b, const Photon<W, NC>& s, M<W> m,
                       I<W> voxel, F<W> share, I<W> corner, F<W> density) {
    using T = F<W>;
    const Vec<T>& d = s.d;
    const I<W> collector = gather(b.collector, voxel);
    m = m & (collector >= 0);
    if (!any(m)) return;

    const T value = select(s.shadow, T{} - share, share);
    const auto straight = m & (s.order == 0);
    std::uint32_t rest = bits_of(m);
    if (k.first_order != 0 && k.light == kLightBeam) {
        if (k.first_order == 1 && any(straight)) {
            const I<W> q = quantise(value, k.scale);
            for (int c = 0; c < NC; ++c)
                add_lanes<W>(k, b, bits_of(straight), collector, &q, c, k.coefficients - 1, 1);
        }
        rest &= ~bits_of(straight);
        if (rest == 0) return;
    }

    if (k.mode == kDepositCamera) {
        Vec<T> to{all<T>(k.camera[0]), all<T>(k.camera[1]), all<T>(k.camera[2])};
        if (!k.orthographic)
            to = normalized(Vec<T>{to.x - s.p.x * k.grid.cell[0], to.y - s.p.y * k.grid.cell[1],
                                   to.z - s.p.z * k.grid.cell[2]});
        T p[NC];
        towards_camera<W, NC>(k, b, corner, density, one_minus_cosine(d, to), p);
        for (int c = 0; c < NC; ++c) {
            const I<W> q = quantise(value * s.weight[c] * p[c], k.scale);
            add_lanes<W>(k, b, rest, collector, &q, c, 0, 1);
        }
        return;
    }

    T y[kMaxBands * kMaxBands + kMaxAxisDegrees];
    I<W> q[kMaxBands * kMaxBands + kMaxAxisDegrees];
    sh_values(k.bands, d, y);
    int count = k.bands * k.bands;
    if (k.axis_degrees > 0 && k.light == kLightBeam) {
        // Beyond the bands, keep what lies evenly around the beam.
        const T cosine = d.x * k.direction[0] + d.y * k.direction[1] + d.z * k.direction[2];
        axis_values(k.bands, k.axis_degrees, cosine, y + count);
        count += k.axis_degrees;
    }
    for (int c = 0; c < NC; ++c) {
        const T weighted = value * s.weight[c];
        for (int i = 0; i < count; ++i) q[i] = quantise(weighted * y[i], k.scale);
        add_lanes<W>(k, b, rest, collector, q, c, 0, count);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
