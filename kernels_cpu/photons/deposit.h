// SPDX-License-Identifier: Apache-2.0
// Adds what a collision tells about the light into integer sums.
// in: direction, share and collector per lane -> out: sums[collector][channel][coefficient].
// docs/methods.md 3, repairs 2 and 3: sum_i w rho/rho_T y_i(incident) estimates the incident light.
#pragma once
#include "kernels_cpu/core/accumulate.h"
#include "kernels_cpu/core/fixed.h"
#include "kernels_cpu/core/pack.h"
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/light/lamp.h"
#include "kernels_cpu/photons/meter_params.h"
#include "kernels_cpu/photons/meters.h"
#include "kernels_cpu/photons/trace_start.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Adds `count` quantised values of the chosen lanes to slots [first, first + count).
template <int W>
PILEUS_FN void add_lanes(const TraceParams& k, const TraceBuffers& b, std::uint32_t lanes,
                         I<W> collector, const I<W>* quanta, int channel, int first, int count) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const std::int64_t set = std::int64_t(lane(collector, i)) * k.channels + channel;
        std::int64_t* sums = b.sums + set * k.coefficients + first;
        add_sums(sums, quanta, i, count, b.shared_sums != 0);
    }
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

/// Of the light that collides at `corner`, where the `density` was looked up, the share that the
/// media absorb in channel `c`, over the largest 1 - albedo of all media: that factor is left to
/// the reconstruction, so that weak absorption keeps its digits.
template <int W>
PILEUS_FN F<W> absorbed_share(const TraceParams& k, const TraceBuffers& b, I<W> corner,
                              F<W> density, int c) {
    using T = F<W>;
    float most = 0.0f;
    for (int i = 0; i < k.media; ++i) {
        const float lost = 1.0f - k.optics[i].albedo[c];
        most = lost > most ? lost : most;
    }
    if (k.media <= 1 || most <= 0.0f) return all<T>(most > 0.0f ? 1.0f : 0.0f);
    T sum{};
    for_shares(
        b.parts, voxels_of(k.grid), k.media, density,
        [&](const float* grid) { return gather(grid, corner); },
        [&](int i, T part) { sum = sum + part * ((1.0f - k.optics[i].albedo[c]) / most); });
    return sum;
}

/// Lanes of photons that move in turn; what they leave behind is gathered into full vectors.
constexpr int kGroups = 6;

/// Light to be added to collectors, waiting until a whole vector of it has come together.
template <int W, int NC>
struct DepositQueue {
    static constexpr int kRoom = (2 * kGroups + 4) * W;
    float x[kRoom], y[kRoom], z[kRoom];  // direction of travel
    float share[NC][kRoom];              // weight times acceptance, negative for shadows
    std::int32_t collector[kRoom];
    float along[kRoom];        // lamps only: cosine to the way straight from the lamp,
    std::int32_t axis[kRoom];  // and whose axis that is; -1: none
    std::int32_t count;
};

/// The same of photons of lamps, where degrees are kept about the lamps' axes.
template <int W>
struct AlongLamp {
    F<W> along;
    I<W> axis;
};

/// Asks for the sums that a vector of deposits will add to.
template <int W>
PILEUS_FN void fetch_sums(const TraceParams& k, const TraceBuffers& b,
                          const std::int32_t* collector) {
    const std::int32_t stride = k.channels * k.coefficients;
    for (int i = 0; i < W; ++i) {
        const std::int64_t* sums = b.sums + std::int64_t(collector[i]) * stride;
        for (std::int32_t c = 0; c < stride; c += 8) prefetch_to_write_(sums + c);
    }
}

/// Notes what the lanes of `m`, travelling along `d`, bring to their collectors. `lamps`: null
/// where no degrees are kept about lamps.
template <int W, int NC>
PILEUS_FN void push_deposits(DepositQueue<W, NC>& q, const Vec<F<W>>& d, M<W> m, I<W> collector,
                             const F<W> (&share)[NC], const AlongLamp<W>* lamps = nullptr) {
    const std::uint32_t bits = bits_of(m);
    pack(q.x + q.count, d.x, bits);
    pack(q.y + q.count, d.y, bits);
    pack(q.z + q.count, d.z, bits);
    for (int c = 0; c < NC; ++c) pack(q.share[c] + q.count, share[c], bits);
    pack(q.collector + q.count, collector, bits);
    if (lamps != nullptr) {
        pack(q.along + q.count, lamps->along, bits);
        pack(q.axis + q.count, lamps->axis, bits);
    }
    q.count += count_bits(bits);
}

PILEUS_FN bool keeps_lamp_axes(const TraceParams& k) {
    return k.light == kLightLamps && k.axis_degrees > 0;
}

/// How each lane's photon travels with respect to its lamp's straight light there.
template <int W, int NC, bool S>
PILEUS_FN AlongLamp<W> along_lamp(const TraceParams& k, const Photon<W, NC, S>& s) {
    using T = F<W>;
    AlongLamp<W> out{T{}, all<I<W>>(-1)};
    const Vec<T> p{s.p.x * k.grid.cell[0], s.p.y * k.grid.cell[1], s.p.z * k.grid.cell[2]};
    for (std::int32_t l = 0; l < k.lamp_count; ++l) {
        const LampEmission& e = k.lamps[l];
        const std::int32_t axis = k.lamp_axis + e.own_axis;
        if (e.own_axis < 0 || axis >= k.axes) continue;
        const M<W> mine = s.texel == l;
        if (!any(mine)) continue;
        const LampSight<T> sight = see_lamp(e.lamp, p);
        const T along = T{} - (s.d.x * sight.way.x + s.d.y * sight.way.y + s.d.z * sight.way.z);
        out.along = select(mine, min_(max_(along, all<T>(-1.0f)), all<T>(1.0f)), out.along);
        out.axis = select(mine, all<I<W>>(axis), out.axis);
    }
    return out;
}

/// What is kept of a direction of travel, `Cells`: by a regular grid. Returns how many numbers.
template <bool Cells, class T>
PILEUS_FN int direction_numbers(const TraceParams& k, const Vec<T>& d, T* y) {
    if constexpr (Cells) {
        if (k.mode == kDepositCosine) {
            y[0] = all<T>(1.0f);
            y[1] = d.x * k.axis[0] + d.y * k.axis[1] + d.z * k.axis[2];
            return 2;
        }
    }
    sh_values(k.bands, d, y);
    int count = k.bands * k.bands;
    if (k.axis_degrees > 0 && k.light == kLightBeam) {
        // Beyond the bands, keep what lies evenly around the beam.
        const T cosine = d.x * k.direction[0] + d.y * k.direction[1] + d.z * k.direction[2];
        axis_values(k.bands, k.axis_degrees, cosine, y + count);
        count += k.axis_degrees;
    }
    return count;
}

/// Adds the directions of items [at, at + W) of the queue, or of its last few, to the sums.
template <bool Cells, int W, int NC>
PILEUS_FN void add_deposits(const TraceParams& k, const TraceBuffers& b,
                            const DepositQueue<W, NC>& q, std::int32_t at) {
    using T = F<W>;
    constexpr int kMax = kMaxBands * kMaxBands + kMaxAxisDegrees;
    const Vec<T> d{load<T>(q.x + at), load<T>(q.y + at), load<T>(q.z + at)};
    T y[kMax];
    const int count = direction_numbers<Cells>(k, d, y);
    const bool lamps = keeps_lamp_axes(k);
    if (lamps) axis_values(k.bands, k.axis_degrees, load<T>(q.along + at), y + count);
    const int numbers = lamps ? count + k.axis_degrees : count;
    const std::int32_t items = q.count - at < W ? q.count - at : W;
    I<W> quanta[kMax];
    for (int c = 0; c < NC; ++c) {
        const T share = load<T>(q.share[c] + at);
        for (int i = 0; i < numbers; ++i) quanta[i] = quantise(share * y[i], k.scale);
        for (std::int32_t i = 0; i < items; ++i) {
            const std::int64_t set = std::int64_t(q.collector[at + i]) * k.channels + c;
            std::int64_t* sums = b.sums + set * k.coefficients;
            add_sums(sums, quanta, i, count, b.shared_sums != 0);
            if (!lamps || q.axis[at + i] < 0) continue;
            add_sums(sums + count + q.axis[at + i] * k.axis_degrees, quanta + count, i,
                     k.axis_degrees, b.shared_sums != 0);
        }
    }
}

/// Adds all that waits but the last vector or two, or all: a vector is added when the one after it
/// is full, whose sums are asked for first.
template <bool Cells, int W, int NC>
PILEUS_FN void flush_deposits(const TraceParams& k, const TraceBuffers& b, DepositQueue<W, NC>& q,
                              bool last) {
    std::int32_t at = 0;
    for (; q.count - at >= (last ? 1 : 2 * W); at += W) {
        if (!last) fetch_sums<W>(k, b, q.collector + at + W);
        add_deposits<Cells>(k, b, q, at);
    }
    if (at == 0) return;
    const std::int32_t left = q.count > at ? q.count - at : 0;
    for (std::int32_t i = 0; i < left; ++i) {
        q.x[i] = q.x[at + i], q.y[i] = q.y[at + i], q.z[i] = q.z[at + i];
        for (int c = 0; c < NC; ++c) q.share[c][i] = q.share[c][at + i];
        q.collector[i] = q.collector[at + i];
        q.along[i] = q.along[at + i], q.axis[i] = q.axis[at + i];
    }
    q.count = left;
}

/// The direction from each lane's photon to the camera.
template <int W, int NC, bool S>
PILEUS_FN Vec<F<W>> way_to_camera(const Photon<W, NC, S>& s, const TraceParams& k) {
    using T = F<W>;
    Vec<T> to{all<T>(k.camera[0]), all<T>(k.camera[1]), all<T>(k.camera[2])};
    if (!k.orthographic)
        to = normalized(Vec<T>{to.x - s.p.x * k.grid.cell[0], to.y - s.p.y * k.grid.cell[1],
                               to.z - s.p.z * k.grid.cell[2]});
    return to;
}

/// push_deposits along s.d, with what is kept about the photon's own lamp.
template <int W, int NC, bool S>
PILEUS_FN void push_by_light(const TraceParams& k, DepositQueue<W, NC>& q,
                             const Photon<W, NC, S>& s, M<W> m, I<W> collector,
                             const F<W> (&share)[NC]) {
    if (!keeps_lamp_axes(k)) {
        push_deposits(q, s.d, m, collector, share);
        return;
    }
    const AlongLamp<W> lamps = along_lamp(k, s);
    push_deposits(q, s.d, m, collector, share, &lamps);
}

/// Deposit `share` (0..1) of each lane in `m`, travelling along s.d, into its voxel's collector.
/// Every lane's voxel must be readable, and `corner`, where the `density` was looked up.
template <int W, int NC, bool S>
PILEUS_FN void deposit(const TraceParams& k, const TraceBuffers& b, DepositQueue<W, NC>& q,
                       const Photon<W, NC, S>& s, M<W> m, I<W> voxel, F<W> share, I<W> corner,
                       F<W> density) {
    using T = F<W>;
    const Vec<T>& d = s.d;
    const I<W> collector = gather(b.collector, voxel);
    m = m & (collector >= 0);
    const T value = select(s.shadow, T{} - share, share);
    if (k.light == kLightLamps) m = m & (s.strayed != 0);
    if (k.first_order != 0 && k.light == kLightBeam) {
        const auto straight = m & (s.strayed == 0);
        if (k.first_order == 1 && any(straight)) {
            const I<W> quanta = quantise(value, k.scale);
            for (int c = 0; c < NC; ++c)
                add_lanes<W>(k, b, bits_of(straight), collector, &quanta, c, k.coefficients - 1, 1);
        }
        m = m & lnot(straight);
    }
    if (!any(m)) return;

    if (is_metered(k)) {
        for (int c = 0; c < NC; ++c) {
            const T lost = absorbed_share<W>(k, b, corner, density, c);
            const I<W> quanta = quantise(value * s.weight[c] * lost, k.scale);
            add_lanes<W>(k, b, bits_of(m), collector, &quanta, c, 0, 1);
        }
        return;
    }
    if (k.mode != kDepositCamera) {
        T shares[NC];
        for (int c = 0; c < NC; ++c) shares[c] = value * s.weight[c];
        push_by_light(k, q, s, m, collector, shares);
        return;
    }
    const Vec<T> to = way_to_camera(s, k);
    T p[NC];
    towards_camera<W, NC>(k, b, corner, density, one_minus_cosine(d, to), p);
    for (int c = 0; c < NC; ++c) {
        const I<W> quanta = quantise(value * s.weight[c] * p[c], k.scale);
        add_lanes<W>(k, b, bits_of(m), collector, &quanta, c, 0, 1);
    }
}

/// The cell of the regular grid that holds a position in or on the box.
template <class T>
PILEUS_FN auto cell_of(const Vec<T>& p, const TraceParams& k) {
    const auto along = [&](T at, int a) {
        return min_(max_(to_int(at * k.cells_per_voxel[a]), I_of<T>{}),
                    all<I_of<T>>(k.cells[a] - 1));
    };
    return (along(p.z, 2) * k.cells[1] + along(p.y, 1)) * k.cells[0] + along(p.x, 0);
}

/// Deposit the track length that a tentative collision of each lane in `m` stands for, in units of
/// the longest one, 1 / (cell_density sigma): no deposit is over 1.
template <int W, int NC, bool S>
PILEUS_FN void deposit_in_cell(const TraceParams& k, const TraceBuffers& b, DepositQueue<W, NC>& q,
                               const Photon<W, NC, S>& s, M<W> m, I<W> cell) {
    using T = F<W>;
    if ((k.first_order != 0 && k.light == kLightBeam) || k.light == kLightLamps)
        m = m & (s.strayed != 0);
    if (!any(m)) return;
    const T length = min_(k.cell_density / s.bound, all<T>(1.0f));
    const T value = select(s.shadow, T{} - length, length);
    if (k.mode != kDepositCamera) {
        T shares[NC];
        for (int c = 0; c < NC; ++c) shares[c] = value * s.weight[c];
        push_by_light(k, q, s, m, cell, shares);
        return;
    }
    const T p = phase_density(k.optics[0].phase, one_minus_cosine(s.d, way_to_camera(s, k)));
    for (int c = 0; c < NC; ++c) {
        const I<W> quanta = quantise(value * s.weight[c] * p, k.scale);
        add_lanes<W>(k, b, bits_of(m), cell, &quanta, c, 0, 1);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
