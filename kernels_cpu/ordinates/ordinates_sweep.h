// SPDX-License-Identifier: Apache-2.0
// One iteration of discrete ordinates: sources from moments, a sweep of each direction, moments.
// in: moments of the radiance on nodes -> out: those after one more scattering.
// docs/ordinates.md. The step characteristic: what leaves a node is what enters it, less what its
// extinction takes, and its source; so no light is made, and none is negative. Each node's sum has
// one order of its terms.
#pragma once
#include "kernels_cpu/core/lanes.h"
#include "kernels_cpu/ordinates/ordinates_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN T load_nodes(const float* from, std::int64_t apart) {
    T v;
    if (apart == 1) {
        __builtin_memcpy(&v, from, sizeof v);
        return v;
    }
    float each[sizeof(T) / sizeof(float)];
    for (std::size_t l = 0; l < sizeof(T) / sizeof(float); ++l)
        each[l] = from[std::int64_t(l) * apart];
    __builtin_memcpy(&v, each, sizeof v);
    return v;
}
template <class T>
PILEUS_FN void store_nodes(float* to, std::int64_t apart, T v) {
    float each[sizeof(T) / sizeof(float)];
    __builtin_memcpy(each, &v, sizeof v);
    for (std::size_t l = 0; l < sizeof(T) / sizeof(float); ++l)
        to[std::int64_t(l) * apart] = each[l];
}

template <class T>
PILEUS_FN void ordinate_source_at(const OrdinatesParams& k, const OrdinatesBuffers& b, int j,
                                  const float (&factor)[kOrdinateMoments], std::int64_t nodes,
                                  std::int64_t at) {
    T sum{};
    for (int m = 0; m < kOrdinateMoments; ++m)
        sum = sum + load_nodes<T>(b.moments + m * nodes + at, 1) * factor[m];
    if (b.beam != nullptr) sum = sum + load_nodes<T>(b.beam + at, 1) * k.beam[j];
    // A mixed start may lead below.
    sum = max_(sum, T{});
    __builtin_memcpy(b.radiance + j * nodes + at, &sum, sizeof sum);
}

/// Radiance that all nodes scatter into a direction.
template <int W>
PILEUS_FN void ordinate_source(const OrdinatesParams& k, const OrdinatesBuffers& b, int j) {
    const std::int64_t nodes = std::int64_t(k.size[0]) * k.size[1] * k.size[2];
    float factor[kOrdinateMoments];
    for (int m = 0; m < kOrdinateMoments; ++m) factor[m] = k.scatter[m] * k.harmonic[j][m];
    std::int64_t at = 0;
    for (; at + W <= nodes; at += W) ordinate_source_at<F<W>>(k, b, j, factor, nodes, at);
    for (; at < nodes; ++at) ordinate_source_at<float>(k, b, j, factor, nodes, at);
}

/// A row of the slice before, and where the one of this goes.
struct OrdinateRow {
    const float* before[2];  ///< at the row's first node, across
    const float *pass, *mean;
    float *radiance, *out;
    std::int64_t apart;  ///< of nodes along the row, in the grid
};
template <class T>
PILEUS_FN void ordinate_nodes(const OrdinateSweep& s, const OrdinateRow& r, std::int64_t i) {
    const T in = (load_nodes<T>(r.before[0] + i, 1) * s.weight[0][0] +
                  load_nodes<T>(r.before[0] + i + 1, 1) * s.weight[0][1]) +
                 (load_nodes<T>(r.before[1] + i, 1) * s.weight[1][0] +
                  load_nodes<T>(r.before[1] + i + 1, 1) * s.weight[1][1]);
    const T source = load_nodes<T>(r.radiance + i * r.apart, r.apart);
    const T over = in - source;
    const T out = source + over * load_nodes<T>(r.pass + i * r.apart, r.apart);
    const T mean = source + over * load_nodes<T>(r.mean + i * r.apart, r.apart);
    __builtin_memcpy(r.out + i, &out, sizeof out);
    store_nodes(r.radiance + i * r.apart, r.apart, mean);
}

/// One direction through all nodes.
template <int W>
PILEUS_FN void ordinate_sweep(const OrdinatesParams& k, const OrdinatesBuffers& b, int j) {
    const OrdinateSweep& s = k.sweep[j];
    const std::int64_t stride[3] = {1, k.size[0], std::int64_t(k.size[0]) * k.size[1]};
    const std::int64_t nodes = stride[2] * k.size[2];
    const std::int32_t n = k.size[s.along], rows = k.size[s.across], slices = k.size[s.axis];
    const std::int64_t row = ordinate_row(k, s), slice = row * (rows + 2);
    const bool wraps = k.periodic != 0;
    // Rows begin one node early where the grid ends, so that all four neighbours are there.
    const std::int64_t first = wraps ? 0 : 1;
    for (std::int64_t i = 0; i < 2 * slice; ++i) b.slices[i] = k.enters[j];
    for (std::int32_t turn = 0; turn < slices; ++turn) {
        const float* before = b.slices + (turn & 1) * slice;
        float* out = b.slices + (1 - (turn & 1)) * slice;
        const std::int64_t plane = stride[s.axis] * (s.up != 0 ? turn : slices - 1 - turn);
        for (std::int32_t y = 0; y < rows; ++y) {
            const std::int64_t at = plane + stride[s.across] * y;
            OrdinateRow r{};
            for (int i = 0; i < 2; ++i) {
                std::int64_t from = y + s.base[1] + i + first;
                if (wraps) from = from % rows;
                r.before[i] = before + from * row + first + s.base[0];
            }
            r.pass = b.pass + s.length * nodes + at;
            r.mean = b.mean + s.length * nodes + at;
            r.radiance = b.radiance + j * nodes + at;
            r.out = out + (y + first) * row + first;
            r.apart = stride[s.along];
            std::int64_t i = 0;
            for (; i + W <= n; i += W) ordinate_nodes<F<W>>(s, r, i);
            for (; i < n; ++i) ordinate_nodes<float>(s, r, i);
            for (i = n; wraps && i < row; ++i) r.out[i] = r.out[i - n];
        }
    }
}

/// Directions [begin, end): their sources, and their radiance on all nodes.
template <int W>
PILEUS_FN void ordinate_directions(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                   std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t j = begin; j < end; ++j) {
        ordinate_source<W>(k, b, int(j));
        ordinate_sweep<W>(k, b, int(j));
    }
}

template <class T>
PILEUS_FN void ordinate_moments_at(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                   std::int64_t nodes, std::int64_t at) {
    T sum[kOrdinateMoments] = {};
    for (int j = 0; j < kOrdinates; ++j) {
        const T own = load_nodes<T>(b.radiance + j * nodes + at, 1) * k.weight[j];
        for (int m = 0; m < kOrdinateMoments; ++m) sum[m] = sum[m] + own * k.harmonic[j][m];
    }
    for (int m = 0; m < kOrdinateMoments; ++m)
        __builtin_memcpy(b.moments + m * nodes + at, &sum[m], sizeof(T));
}

/// Moments of the radiance in planes [begin, end) of nodes along z.
template <int W>
PILEUS_FN void ordinate_moments(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                std::uint32_t begin, std::uint32_t end) {
    const std::int64_t plane = std::int64_t(k.size[0]) * k.size[1], nodes = plane * k.size[2];
    std::int64_t at = plane * begin;
    for (; at + W <= plane * end; at += W) ordinate_moments_at<F<W>>(k, b, nodes, at);
    for (; at < plane * end; ++at) ordinate_moments_at<float>(k, b, nodes, at);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
