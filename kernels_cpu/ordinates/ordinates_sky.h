// SPDX-License-Identifier: Apache-2.0
// Discrete ordinates of a sky in place: what lies in nodes, and the march that reads their levels.
// in: a layer, levels of nodes around the camera -> out: densities, depths to the sun, pixels.
// docs/ordinates.md, "Skies"
#pragma once
#include "kernels_cpu/ordinates/ordinates_march.h"
#include "kernels_cpu/ordinates/ordinates_sky_params.h"
#include "kernels_cpu/raymarch/raymarch_sky.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Nodes around a place in its level and in the next coarser one.
template <class T>
struct LevelCorners {
    Corners<T> near, far;
    Corners<T> finest;  ///< where moments are: of places that are near the camera alone
    M_of<T> is_finest;
    T share;     ///< of the coarser one
    bool mixed;  ///< whether some lane has such a share
};

template <class T>
PILEUS_FN T interpolate(const float* nodes, const LevelCorners<T>& at) {
    const T near = interpolate(nodes, at.near);
    if (!at.mixed) return near;
    return near + (interpolate(nodes, at.far) - near) * at.share;
}

template <class T>
PILEUS_FN const Corners<T>& moment_corners(const LevelCorners<T>& at) {
    return at.finest;
}

template <class T>
PILEUS_FN T in_finest(const LevelCorners<T>& at, T share) {
    return select(at.is_finest, share, T{});
}

/// Where a level is read, per lane.
template <class T>
struct LevelPlace {
    T x, y;           ///< in nodes
    I_of<T> numbers;  ///< of the levels before
};
template <class T>
PILEUS_FN LevelPlace<T> level_place(const OrdinateLevelsView& v, int level, std::int64_t nodes,
                                    const Vec<T>& p) {
    return {(p.x - v.low[level][0]) * v.per_metre[level][0],
            (p.y - v.low[level][1]) * v.per_metre[level][1],
            all<I_of<T>>(std::int32_t(level * nodes))};
}
template <class T>
PILEUS_FN LevelPlace<T> choose_place(M_of<T> first, const LevelPlace<T>& a,
                                     const LevelPlace<T>& b) {
    return {select(first, a.x, b.x), select(first, a.y, b.y), select(first, a.numbers, b.numbers)};
}

template <class T>
PILEUS_FN Corners<T> level_corners(const OrdinatesMarchParams& o, const LevelPlace<T>& at, T z) {
    return node_corners(Vec<T>{at.x, at.y, z}, o.nodes.size, o.levels.wraps != 0);
}
template <class T>
PILEUS_FN Corners<T> of_level(Corners<T> c, I_of<T> numbers) {
    c.x0 = c.x0 + numbers;
    c.x1 = c.x1 + numbers;
    return c;
}

/// A level blends to the next one over the last quarter of its reach, so that nothing pops.
template <class T>
PILEUS_FN LevelCorners<T> ordinate_corners(const SkyMedium& f, const OrdinatesMarchParams& o,
                                           const Vec<T>& p) {
    const OrdinateLevelsView& v = o.levels;
    const SkyParams& k = *f.sky;
    const std::int64_t nodes = ordinate_level(o);
    const T share = (altitude(k, sky_world(k, p)) - k.low_m) * k.inverse_m;
    const T z = min_(max_(share, T{}), all<T>(1.0f)) * float(o.nodes.size[2]);
    LevelPlace<T> near = level_place(v, v.count - 1, nodes, p);
    if (v.wraps != 0) {
        near.x = wrap_place(near.x, float(o.nodes.size[0]));
        near.y = wrap_place(near.y, float(o.nodes.size[1]));
    }
    LevelPlace<T> far = near;
    LevelCorners<T> out{};
    for (int level = v.count - 2; level >= 0; --level) {
        const T off = max_(abs_(p.x - v.middle[level][0]) * v.per_reach[level][0],
                           abs_(p.y - v.middle[level][1]) * v.per_reach[level][1]);
        const auto within = off < 1.0f;
        if (!any(within)) break;
        far = choose_place(within, near, far);
        near = choose_place(within, level_place(v, level, nodes, p), near);
        out.share = select(within, max_(4.0f * off - 3.0f, T{}), out.share);
    }
    out.finest = level_corners(o, near, z);
    out.is_finest = near.numbers == 0;
    out.near = of_level(out.finest, near.numbers);
    out.mixed = any(out.share > 0.0f);
    if (out.mixed) out.far = of_level(level_corners(o, far, z), far.numbers);
    return out;
}

template <int W>
PILEUS_FN void ordinates_sky_rows(const OrdinatesSkyParams& k, const OrdinatesMarchBuffers& b,
                                  std::uint32_t begin, std::uint32_t end) {
    ordinates_blocks<W>(k.march, b, SkyMedium{&k.sky, b.march.sky_light}, begin, end);
}

/// Lanes of a row of places, from column x on.
template <int W>
PILEUS_FN Vec<F<W>> places_of_row(const SkyParams& sky, const SkyPlaces& at, std::int32_t x,
                                  std::uint32_t row) {
    using T = F<W>;
    const std::uint32_t rows = std::uint32_t(at.size[1]);
    const float y = at.low[1] + (float(row % rows) + 0.5f) * at.step[1];
    const float share = (float(row / rows) + 0.5f) / float(at.size[2]);
    const T along = at.low[0] + (to_float(iota<I<W>>() + x) + 0.5f) * at.step[0];
    return sky_light_place(sky, along, all<T>(y), share);
}

template <int W>
PILEUS_FN void sky_sample_rows(const SkySampleParams& k, const SkySampleBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const std::int32_t n = k.places.size[0];
    const SkyMedium field{&k.sky, nullptr};
    for (std::uint32_t row = begin; row < end; ++row) {
        float* density = b.density + std::int64_t(row) * n;
        for (std::int32_t x = 0; x < n; x += W) {
            const Vec<T> p = places_of_row<W>(k.sky, k.places, x, row);
            T value{};
            if (k.sunward == 0) {
                value =
                    select(field_holds(field, p), sky_density(k.sky, p, all<T>(k.width_m)), T{});
            } else {
                T held{};
                for (int l = 0; l < W && x + l < n; ++l) set_lane(held, l, density[x + l]);
                const auto wanted = held > 0.0f;
                if (!any(wanted)) continue;
                std::int64_t counts[kRaymarchCounts] = {};
                value = march_to_sun(k.march, field, p, wanted, counts, 0, k.march.light.steps).tau;
            }
            float* to = k.sunward == 0 ? density : b.depth + std::int64_t(row) * n;
            for (int l = 0; l < W && x + l < n; ++l) to[x + l] = lane(value, l);
        }
    }
}

template <int W>
PILEUS_FN void sky_turn_rows(const SkyNodeTurnParams& k, const SkyNodeTurnBuffers& b,
                             std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const std::int32_t* size = k.places.size;
    const std::int32_t n = size[0] - 2 * k.ring, rows = size[1] - 2 * k.ring;
    const std::int64_t nodes = std::int64_t(n) * rows * size[2];
    for (std::uint32_t i = begin; i < end; ++i) {
        const std::int32_t z = std::int32_t(i) / rows, y = std::int32_t(i) % rows + k.ring;
        const std::uint32_t row = std::uint32_t(z * size[1] + y);
        for (std::int32_t x = 0; x < n; x += W) {
            const Vec<T> p = places_of_row<W>(k.sky, k.places, x + k.ring, row);
            const auto way = [&](int a, T at) {
                return k.orthographic != 0 ? all<T>(0.0f - k.camera[a]) : k.camera[a] - at;
            };
            const Vec<T> d{way(0, p.x), way(1, p.y), way(2, p.z)};
            const T square = max_(d.x * d.x + d.y * d.y + d.z * d.z, all<T>(1e-20f));
            const T unit = 1.0f / sqrt_(square);
            T harmonic[kOrdinateMoments], sum{};
            sh_eval<4>(d.x * unit, d.y * unit, d.z * unit, harmonic);
            for (int m = 0; m < kOrdinateMoments; ++m) {
                T own{};
                const float* from = b.moments + m * nodes + std::int64_t(i) * n + x;
                for (int l = 0; l < W && x + l < n; ++l) set_lane(own, l, from[l]);
                sum = sum + own * harmonic[m] * k.scatter[ordinate_degree(m)];
            }
            sum = max_(sum, T{});
            float* to = b.light + std::int64_t(row) * size[0] + x + k.ring;
            for (int l = 0; l < W && x + l < n; ++l) to[l] = lane(sum, l);
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
