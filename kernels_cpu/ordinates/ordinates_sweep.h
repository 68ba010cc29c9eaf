// SPDX-License-Identifier: Apache-2.0
// One iteration of discrete ordinates: sources from moments, a sweep of each direction, moments.
// in: moments of the radiance on nodes that hold medium -> out: those after one more scattering.
// docs/ordinates.md. The step characteristic: what leaves a node is what enters it, less what its
// extinction takes, and its source; so no light is made, and none is negative. Each node's sum has
// one order of its terms.
#pragma once
#include "kernels_cpu/core/lanes.h"
#include "kernels_cpu/ordinates/ordinates_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Places of a direction's nodes in `radiance`, of those that hold medium.
PILEUS_FN const std::int32_t* ordinate_places(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                              int j) {
    return k.sweep[j].axis == 0 ? b.place_x : b.place;
}

template <class T>
PILEUS_FN T load_row(const float* from) {
    T v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}

/// What each medium of a node scatters, by its part of the extinction that counts.
template <class T>
PILEUS_FN T ordinate_parts(const OrdinatesParams& k, const OrdinatesBuffers& b, int j,
                           const T (&moment)[kOrdinateMoments], T beam, std::int64_t at) {
    T degree[4] = {}, sum{};
    for (int m = 0; m < kOrdinateMoments; ++m)
        degree[ordinate_degree(m)] = degree[ordinate_degree(m)] + moment[m] * k.harmonic[j][m];
    for (int i = 0; i < k.media; ++i) {
        T own = beam * k.beam[i][j];
        for (int l = 0; l < 4; ++l) own = own + degree[l] * k.scatter[i][l];
        sum = sum + own * load_row<T>(b.part + i * k.filled + at);
    }
    return sum;
}

template <class T>
PILEUS_FN void ordinate_sources_at(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                   std::int64_t at) {
    constexpr int lanes = int(sizeof(T) / sizeof(float));
    const std::int64_t nodes = std::int64_t(k.size[0]) * k.size[1] * k.size[2];
    T moment[kOrdinateMoments], beam{};
    for (int m = 0; m < kOrdinateMoments; ++m)
        moment[m] = load_row<T>(b.moments + m * k.filled + at);
    if (b.beam != nullptr) beam = load_row<T>(b.beam + at);
    if (b.part == nullptr)
        for (int m = 0; m < kOrdinateMoments; ++m)
            moment[m] = moment[m] * k.scatter[0][ordinate_degree(m)];
    for (int j = 0; j < kOrdinates; ++j) {
        T sum{};
        if (b.part != nullptr) {
            sum = ordinate_parts(k, b, j, moment, beam, at);
        } else {
            for (int m = 0; m < kOrdinateMoments; ++m) sum = sum + moment[m] * k.harmonic[j][m];
            sum = sum + beam * k.beam[0][j];
        }
        // A mixed start may lead below.
        sum = max_(sum, T{});
        if (b.fixed != nullptr) sum = sum + load_row<T>(b.fixed + j * k.filled + at);
        float each[lanes];
        __builtin_memcpy(each, &sum, sizeof sum);
        const std::int32_t* place = ordinate_places(k, b, j) + at;
        for (int l = 0; l < lanes; ++l) b.radiance[j * nodes + place[l]] = each[l];
    }
}

/// Radiance that nodes [begin, end) of those that hold medium scatter into all directions.
template <int W>
PILEUS_FN void ordinate_sources(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                std::uint32_t begin, std::uint32_t end) {
    std::int64_t at = begin;
    for (; at + W <= end; at += W) ordinate_sources_at<F<W>>(k, b, at);
    for (; at < end; ++at) ordinate_sources_at<float>(k, b, at);
}

/// A row of the slice before, and where the one of this goes.
struct OrdinateRow {
    const float* before[2];  ///< at the row's first node, across
    const float *pass, *mean;
    float *radiance, *out;
};
template <class T>
PILEUS_FN T ordinate_enters(const float (&weight)[2][2], const OrdinateRow& r, std::int64_t i) {
    return (load_row<T>(r.before[0] + i) * weight[0][0] +
            load_row<T>(r.before[0] + i + 1) * weight[0][1]) +
           (load_row<T>(r.before[1] + i) * weight[1][0] +
            load_row<T>(r.before[1] + i + 1) * weight[1][1]);
}
template <class T>
PILEUS_FN void ordinate_nodes(const OrdinateSweep& s, const OrdinateRow& r, std::int64_t i) {
    const T in = ordinate_enters<T>(s.weight, r, i);
    const T source = load_row<T>(r.radiance + i), over = in - source;
    const T out = source + over * load_row<T>(r.pass + i);
    const T mean = source + over * load_row<T>(r.mean + i);
    __builtin_memcpy(r.out + i, &out, sizeof out);
    __builtin_memcpy(r.radiance + i, &mean, sizeof mean);
}

/// Node `i` of a row behind a wall: what it will hold, before the row takes its source.
PILEUS_FN void ordinate_behind(const OrdinateRow& r, std::int64_t i, OrdinateWall& wall) {
    const float in = ordinate_enters<float>(wall.weight, r, i) + wall.sends;
    const float source = r.radiance[i], over = in - source;
    wall.out = source + over * r.pass[i];
    wall.mean = source + over * r.mean[i];
}

/// One direction through all nodes.
template <int W>
PILEUS_FN void ordinate_sweep(const OrdinatesParams& k, const OrdinatesBuffers& b, int j) {
    const OrdinateSweep& s = k.sweep[j];
    const std::int64_t nodes = std::int64_t(k.size[0]) * k.size[1] * k.size[2];
    const std::int32_t n = k.size[s.along], rows = k.size[s.across], slices = k.size[s.axis];
    // Rows are along x, or of slices along x along y: one after the other in memory.
    const std::int64_t across = s.axis == 1 ? std::int64_t(k.size[0]) * k.size[1] : n;
    const std::int64_t between = s.axis == 1 ? n : std::int64_t(n) * rows;
    const std::int64_t row = ordinate_row(k, s), slice = row * (rows + 2);
    const bool wraps = k.periodic != 0;
    // Rows begin one node early where the grid ends, so that all four neighbours are there.
    const std::int64_t first = wraps ? 0 : 1;
    const auto fill = [](float* to, std::int64_t count, float radiance) {
        for (std::int64_t i = 0; i < count; ++i) to[i] = radiance;
    };
    fill(b.slices, 2 * slice, k.enters[j]);
    // The lower face lies before the first of slices along z, and before the first row of others.
    const bool other_below = k.below[j] != k.enters[j];
    for (int i = 0; i < 2 && other_below && s.axis != 2; ++i)
        fill(b.slices + i * slice, row, k.below[j]);
    if (other_below && s.axis == 2) fill(b.slices, slice, k.below[j]);
    std::int32_t wall = b.walls != nullptr ? b.first_wall[j] : 0;
    const std::int32_t walls = b.walls != nullptr ? b.first_wall[j + 1] : 0;
    for (std::int32_t turn = 0; turn < slices; ++turn) {
        if (other_below && s.axis == 2 && turn == 1) fill(b.slices, slice, k.enters[j]);
        const float* before = b.slices + (turn & 1) * slice;
        float* out = b.slices + (1 - (turn & 1)) * slice;
        const std::int64_t plane = between * (s.up != 0 ? turn : slices - 1 - turn);
        for (std::int32_t y = 0; y < rows; ++y) {
            const std::int64_t at = plane + across * y;
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
            const std::int32_t own = wall;
            for (; wall < walls && std::uint64_t(b.walls[wall].place - at) < std::uint64_t(n);
                 ++wall)
                ordinate_behind(r, b.walls[wall].place - at, b.walls[wall]);
            std::int64_t i = 0;
            for (; i + W <= n; i += W) ordinate_nodes<F<W>>(s, r, i);
            for (; i < n; ++i) ordinate_nodes<float>(s, r, i);
            for (std::int32_t w = own; w < wall; ++w) {
                r.out[b.walls[w].place - at] = b.walls[w].out;
                r.radiance[b.walls[w].place - at] = b.walls[w].mean;
            }
            for (i = n; wraps && i < row; ++i) r.out[i] = r.out[i - n];
        }
    }
}

/// Directions [begin, end): their radiance on all nodes.
template <int W>
PILEUS_FN void ordinate_directions(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                   std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t j = begin; j < end; ++j) ordinate_sweep<W>(k, b, int(j));
}

template <class T>
PILEUS_FN void ordinate_moments_at(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                   std::int64_t at) {
    constexpr int lanes = int(sizeof(T) / sizeof(float));
    const std::int64_t nodes = std::int64_t(k.size[0]) * k.size[1] * k.size[2];
    T sum[kOrdinateMoments] = {};
    for (int j = 0; j < kOrdinates; ++j) {
        const std::int32_t* place = ordinate_places(k, b, j) + at;
        float each[lanes];
        for (int l = 0; l < lanes; ++l) each[l] = b.radiance[j * nodes + place[l]];
        const T own = load_row<T>(each) * k.weight[j];
        for (int m = 0; m < kOrdinateMoments; ++m) sum[m] = sum[m] + own * k.harmonic[j][m];
    }
    for (int m = 0; m < kOrdinateMoments; ++m)
        __builtin_memcpy(b.moments + m * k.filled + at, &sum[m], sizeof(T));
}

/// Moments of the radiance in nodes [begin, end) of those that hold medium.
template <int W>
PILEUS_FN void ordinate_moments(const OrdinatesParams& k, const OrdinatesBuffers& b,
                                std::uint32_t begin, std::uint32_t end) {
    std::int64_t at = begin;
    for (; at + W <= end; at += W) ordinate_moments_at<F<W>>(k, b, at);
    for (; at < end; ++at) ordinate_moments_at<float>(k, b, at);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
