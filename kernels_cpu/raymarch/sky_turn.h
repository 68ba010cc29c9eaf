// SPDX-License-Identifier: Apache-2.0
// Skylight of nodes as a camera sees it: what each part of the sky sends, weighed by how much of it
// is scattered along the way from the camera.
// in: SkyTurnParams, SkyTurnBuffers -> out: brightness of nodes, at most 1.
// docs/raymarch.md, "Skylight"
#pragma once
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/raymarch/sky_turn_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The way from the camera to each of W nodes, a unit vector, and how much of it is known.
template <int W>
struct NodeWay {
    Vec<F<W>> way;
    F<W> known;
};
template <int W>
PILEUS_FN NodeWay<W> node_way(const SkyTurnParams& k, std::uint32_t n) {
    using T = F<W>;
    const std::int32_t nx = k.grid.size[0], ny = k.grid.size[1];
    std::int32_t at[3] = {std::int32_t(n % std::uint32_t(nx)),
                          std::int32_t(n / std::uint32_t(nx) % std::uint32_t(ny)),
                          std::int32_t(n / std::uint32_t(nx) / std::uint32_t(ny))};
    I<W> place[3]{};
    for (int i = 0; i < W; ++i) {
        for (int a = 0; a < 3; ++a) set_lane(place[a], i, at[a]);
        if (++at[0] == nx) {
            at[0] = 0;
            if (++at[1] == ny) at[1] = 0, ++at[2];
        }
    }
    const CameraParams& c = k.camera;
    T d[3], square{};
    for (int a = 0; a < 3; ++a) {
        d[a] = c.orthographic != 0
                   ? all<T>(c.forward[a])
                   : (to_float(place[a]) + 0.5f) / k.grid.per_metre[a] - c.origin[a];
        square = square + d[a] * d[a];
    }
    const T length = sqrt_(square);
    const T scale = select(length > 0.0f, 1.0f / length, T{});
    NodeWay<W> out;
    out.way = {d[0] * scale, d[1] * scale, d[2] * scale};
    out.known = c.orthographic != 0 ? all<T>(1.0f)
                                    : select(length > k.reach, all<T>(1.0f), length / k.reach);
    return out;
}

/// What later octaves bring, over what they would if nothing were absorbed.
template <int W>
PILEUS_FN void add_later_sky(const SkyTurnParams& k, const float* seen, std::size_t nodes,
                             int count, const NodeWay<W>& w, F<W> rest, F<W> (&light)[3]) {
    using T = F<W>;
    T sum[3]{};
    for (int p = 0; p < kSkyParts; ++p) {
        const float* d = k.middles[p];
        const T alike = take_lanes<T>(seen + std::size_t(kSkyParts + p) * nodes, count);
        const T turned = take_lanes<T>(seen + std::size_t(2 * kSkyParts + p) * nodes, count);
        const T along = (d[0] * w.way.x + d[1] * w.way.y + d[2] * w.way.z) * w.known;
        const T comes = alike + turned * along;
        for (int s = 0; s < k.sets; ++s) sum[s] = sum[s] + k.share[s][p] * comes;
    }
    const float* all_parts = seen + std::size_t(3 * kSkyParts) * nodes;
    const T along = take_lanes<T>(all_parts + nodes, count) * w.way.x +
                    take_lanes<T>(all_parts + 2 * nodes, count) * w.way.y +
                    take_lanes<T>(all_parts + 3 * nodes, count) * w.way.z;
    const T white = take_lanes<T>(all_parts, count) + along * w.known;
    const T scale = select((rest > 0.0f) & (white > 0.0f), (float(kSkyParts) * rest) / white, T{});
    for (int s = 0; s < k.sets; ++s) light[s] = light[s] + scale * sum[s];
}

/// Nodes [begin, end), x fastest.
template <int W>
PILEUS_FN void turn_sky(const SkyTurnParams& k, const SkyTurnBuffers& b, std::uint32_t begin,
                        std::uint32_t end) {
    using T = F<W>;
    const std::size_t nodes =
        std::size_t(k.grid.size[0]) * std::size_t(k.grid.size[1]) * std::size_t(k.grid.size[2]);
    constexpr float kMax = float(kSkyPhaseSteps) - 0.001f;
    for (std::uint32_t n = begin; n < end; n += std::uint32_t(W)) {
        const int count = end - n < std::uint32_t(W) ? int(end - n) : W;
        const float* seen = b.seen + n;
        const NodeWay<W> w = node_way<W>(k, n);
        T weight{}, straight{}, sum[3]{}, light[3]{};
        for (int p = 0; p < kSkyParts; ++p) {
            const float* d = k.middles[p];
            const T cosine = d[0] * w.way.x + d[1] * w.way.y + d[2] * w.way.z;
            const T at = min_(max_((cosine + 1.0f) * (0.5f * kSkyPhaseSteps), T{}), all<T>(kMax));
            const auto step = to_int(at);
            const T low = gather(b.phase, step), high = gather(b.phase + 1, step);
            const T own = low + (high - low) * (at - to_float(step));
            const T scattered = 1.0f + (own - 1.0f) * w.known;
            const T sees = take_lanes<T>(seen + std::size_t(p) * nodes, count);
            weight = weight + scattered;
            straight = straight + scattered * sees;
            for (int s = 0; s < k.sets; ++s) sum[s] = sum[s] + k.share[s][p] * scattered * sees;
        }
        const T rest = 1.0f - straight / weight;
        for (int s = 0; s < k.sets; ++s) light[s] = (float(kSkyParts) * sum[s]) / weight;
        if (k.later != 0) add_later_sky<W>(k, seen, nodes, count, w, rest, light);
        // What adds up to one may exceed it by rounding.
        for (int s = 0; s < k.sets; ++s)
            put_lanes(select(light[s] > 1.0f, all<T>(1.0f), light[s]),
                      b.light + std::size_t(s) * nodes + n, count);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
