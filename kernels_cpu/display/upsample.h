// SPDX-License-Identifier: Apache-2.0
// Pixels between marched ones: from their neighbours, or from the picture before.
// in: a lattice of marched pixels, solid depths of all pixels -> out: planes of the whole picture.
// docs/upsampling.md. Marched pixels keep their bits; a pixel reads, it knows no tile.
#pragma once
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/display/upsample_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Four marched pixels around a pixel of the picture, and what each weighs.
template <class T>
struct Around {
    I_of<T> at[4];
    T weight[4];
    M_of<T> marched;        ///< the pixel is one of them
    bool close = false;     ///< those of all lanes lie within one vector of each row:
    std::int32_t begin[2];  ///< the first number of these vectors, of the upper and the lower row
    I_of<T> within[2];      ///< the left and the right one's place in them
};

/// Place between marched pixels along one axis: the lower one, and the share of the higher.
template <class T>
PILEUS_FN void lattice_split(T pixel, const PixelLattice& g, std::int32_t axis, std::int32_t count,
                             I_of<T>& low, I_of<T>& high, T& share) {
    const T place = (pixel - float(g.first[axis])) * (1.0f / float(g.every));
    const T within = max_(min_(place, all<T>(float(count - 1))), T{});
    low = to_int(within);
    high = min_(low + 1, all<I_of<T>>(count - 1));
    share = within - to_float(low);
}

template <class T>
PILEUS_FN Around<T> around(const PixelLattice& g, T x, T y, bool nearest) {
    I_of<T> x0, x1, y0, y1;
    T fx, fy;
    lattice_split(x, g, 0, g.width, x0, x1, fx);
    lattice_split(y, g, 1, g.height, y0, y1, fy);
    Around<T> a;
    const auto column = to_float(x0 * g.every + g.first[0]) == x;
    const auto row = to_float(y0 * g.every + g.first[1]) == y;
    a.marched = column & row;
    if (nearest) {
        fx = select(fx < 0.5f, T{}, all<T>(1.0f));
        fy = select(fy < 0.5f, T{}, all<T>(1.0f));
    }
    a.at[0] = y0 * g.width + x0, a.at[1] = y0 * g.width + x1;
    a.at[2] = y1 * g.width + x0, a.at[3] = y1 * g.width + x1;
    a.weight[0] = (1.0f - fx) * (1.0f - fy), a.weight[1] = fx * (1.0f - fy);
    a.weight[2] = (1.0f - fx) * fy, a.weight[3] = fx * fy;
    return a;
}

/// Whether a vector's lanes can be picked by numbers in another; elsewhere memory is gathered.
#if defined(__clang__) || defined(__CUDACC__)
template <int W>
constexpr bool kPicksLanes = false;
#else
template <int W>
constexpr bool kPicksLanes = W >= 8;
#endif

/// Pixels side by side have their neighbours side by side: a few loads serve all lanes.
template <class T>
PILEUS_FN void find_close(const PixelLattice& g, Around<T>& a) {
    constexpr int W = width_of<T>;
    if (!kPicksLanes<W> || g.width < W || g.every < 2) return;
    const std::int32_t upper = lane(a.at[0], 0) / g.width * g.width;
    const std::int32_t lower = lane(a.at[2], 0) / g.width * g.width;
    const std::int32_t first = lane(a.at[0], 0) - upper;
    const std::int32_t low = first < g.width - W ? first : g.width - W;
    a.close = lane(a.at[1], W - 1) - upper - low < W;
    a.begin[0] = upper + low, a.begin[1] = lower + low;
    a.within[0] = a.at[0] - a.begin[0], a.within[1] = a.at[1] - a.begin[0];
}

/// One of the four marched pixels around.
template <class T>
PILEUS_FN T neighbour(const float* plane, const Around<T>& a, int i) {
#if !defined(__clang__) && !defined(__CUDACC__)
    if constexpr (kPicksLanes<width_of<T>>) {
        if (a.close) {
            T row;
            __builtin_memcpy(&row, plane + a.begin[i >> 1], sizeof row);
            return __builtin_shuffle(row, a.within[i & 1]);
        }
    }
#endif
    return gather(plane, a.at[i]);
}

/// How different two distances are, 0 to 1; infinity, the sky, is like itself alone.
template <class T>
PILEUS_FN T depth_gap(T a, T b) {
    const T p = 1.0f / max_(a, all<T>(1e-6f)), q = 1.0f / max_(b, all<T>(1e-6f));
    return abs_(p - q) / max_(max_(p, q), all<T>(1e-30f));
}

/// Share of the weight that a neighbour before quite another solid thing keeps.
constexpr float kOtherSolid = 1e-3f;

template <class T>
PILEUS_FN void weigh_depths(const UpsampleBuffers& b, T opaque, Around<T>& a) {
    T sum{};
    for (int i = 0; i < 4; ++i) {
        const T gap = depth_gap(opaque, neighbour(b.opaque_depth, a, i));
        a.weight[i] = a.weight[i] * (kOtherSolid / (kOtherSolid + gap * gap));
        sum = sum + a.weight[i];
    }
    // Where one neighbour has all the weight it keeps all of it, exactly.
    for (int i = 0; i < 4; ++i) a.weight[i] = a.weight[i] / max_(sum, all<T>(1e-30f));
}

template <class T>
PILEUS_FN T blended(const float* plane, const Around<T>& a) {
    T sum{};
    for (int i = 0; i < 4; ++i) sum = sum + a.weight[i] * neighbour(plane, a, i);
    return sum;
}

/// The number of the neighbour that weighs most: depths, which may be infinite, are not blended.
template <class T>
PILEUS_FN T heaviest(const float* plane, const Around<T>& a) {
    T value = neighbour(plane, a, 0), most = a.weight[0];
    for (int i = 1; i < 4; ++i) {
        value = select(a.weight[i] > most, neighbour(plane, a, i), value);
        most = max_(most, a.weight[i]);
    }
    return value;
}

/// Transmittance and light of a pixel.
template <class T>
struct PixelLight {
    T value[4];
};

/// Whether none of the four marched pixels around shows anything of the medium.
template <class T>
PILEUS_FN M_of<T> shows_nothing(const UpsampleBuffers& b, std::int64_t few, const Around<T>& a) {
    auto clear = a.at[0] >= 0;
    for (int i = 0; i < 4; ++i) clear = clear & (neighbour(b.transmittance, a, i) == 1.0f);
    // What emits may show where nothing is held back.
    for (int c = 0; c < 3 && any(clear); ++c)
        for (int i = 0; i < 4; ++i) clear = clear & (neighbour(b.colour + c * few, a, i) == 0.0f);
    return clear;
}

/// What is older may lie beyond what is seen now by this share of its range.
constexpr float kBeyond = 0.25f;

/// Between the least and the largest of the four marched pixels around, and a little beyond, but
/// neither below zero nor above `cap` for it.
template <class T>
PILEUS_FN void clamp_around(const float* plane, const Around<T>& a, float cap, T& value) {
    T least = neighbour(plane, a, 0), most = least;
    for (int i = 1; i < 4; ++i) {
        const T v = neighbour(plane, a, i);
        least = min_(least, v), most = max_(most, v);
    }
    const T beyond = kBeyond * (most - least);
    const T low = max_(least - beyond, min_(least, T{}));
    const T high = min_(most + beyond, max_(most, all<T>(cap)));
    value = max_(min_(value, high), low);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
