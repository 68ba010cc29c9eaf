// SPDX-License-Identifier: Apache-2.0
// What lies behind the media where there are solid meshes: they, the ground or the sky.
// in: rays of pixels -> out: radiance and distance, shadows of media and solids on both.
// docs/solids.md, "How they are lit"; without solids background_rows (march.h) does this.
#pragma once
#include "kernels_cpu/display/march_background.h"
#include "kernels_cpu/light/sun_heights.h"
#include "kernels_cpu/solids/solids.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Light on a surface from everything but the sun, over pi: harmonics up to the second degree
/// (Ramamoorthi, Hanrahan 2001), never negative.
template <class T>
PILEUS_FN T around_light(const float (&k)[kAroundTerms], const Vec<T>& n) {
    const T flat = k[0] + k[1] * n.x + k[2] * n.y + k[3] * n.z;
    const T bent = k[4] * n.x * n.y + k[5] * n.y * n.z + k[6] * n.z * n.x +
                   k[7] * (n.x * n.x - n.y * n.y) + k[8] * (3.0f * n.z * n.z - 1.0f);
    return max_(flat + bent, T{});
}

/// A surface that rays have met, and the share of the sun's light that reaches it.
template <class T>
struct LitSurface {
    M_of<T> solid, ground;
    T depth;  // metres along the ray; infinity for the sky
    T sunlight[3];
    SolidPlace<T> place;  // of solids
};

/// Optical depth towards the sun at the lanes of `m`, of which those behind solids are left out.
template <class T>
PILEUS_FN T depth_to_sun(const SolidRowsParams& k, const Vec<T>& at, const Vec<T>& to_sun,
                         M_of<T>& m) {
    if (any(m)) m = m & lnot(behind_solids(k.solids, at, to_sun, all<T>(3e38f), m));
    return any(m) ? optical_depth(k.back.medium, Ray<T>{at, to_sun}, m) : T{};
}

template <class T>
PILEUS_FN LitSurface<T> find_surface(const SolidRowsParams& k, const Ray<T>& ray, M_of<T> real,
                                     bool lit) {
    LitSurface<T> s{};
    s.depth = all<T>(__builtin_inff());
    s.ground = real & lnot(real);
    if (k.back.ground != 0) {
        const T height = ray.origin.z - k.back.ground_z;
        s.ground = real & (ray.direction.z < 0.0f) & (height >= 0.0f);
        s.depth = select(s.ground, height / max_(T{} - ray.direction.z, all<T>(1e-18f)), s.depth);
    }
    const SolidHit<T> hit =
        hit_solids(k.solids, ray.origin, ray.direction, min_(s.depth, all<T>(3e38f)), real);
    s.solid = hit.triangle >= 0;
    s.ground = s.ground & lnot(s.solid);
    s.depth = min_(s.depth, hit.distance);
    if (!lit || !any(s.solid | s.ground)) return s;

    const Vec<T> to_sun{all<T>(k.back.to_sun[0]), all<T>(k.back.to_sun[1]),
                        all<T>(k.back.to_sun[2])};
    s.place = place_on_solid(k.solids, ray.origin, ray.direction, hit);
    const T cosine = dot(s.place.normal, to_sun);
    const Vec<T> flat = along(ray, select(s.ground, s.depth, T{}));
    const Vec<T> at{select(s.solid, s.place.at.x, flat.x), select(s.solid, s.place.at.y, flat.y),
                    select(s.solid, s.place.at.z, flat.z)};
    M_of<T> lit_there = s.ground | (s.solid & (cosine > 0.0f));
    const T tau = depth_to_sun(k, at, to_sun, lit_there);
    T through[3];
    sun_through(k.back, tau, through);
    for (int c = 0; c < 3; ++c) {
        const T sun = select(lit_there, through[c], T{});
        s.sunlight[c] = select(s.solid, sun * max_(cosine, T{}), sun);
    }
    return s;
}

/// What media change of light from all around but the sun, over pi: at their foot, or the ground
/// within them, and below as much as they change of the ground's, `scattered`, above them nothing,
/// and within them what lies between. From below comes the ground's light, in the media's shadow of
/// the sun.
template <class T>
PILEUS_FN void changed_around(const SolidRowsParams& k, const BackgroundBuffers& b,
                              const LitSurface<T>& s, const T (&scattered)[3], T (&out)[3]) {
    const Vec<T>& at = s.place.at;
    const float top = k.back.medium.extent[2], low = k.back.ground_z > 0 ? k.back.ground_z : 0.0f;
    const T share = min_(max_((top - at.z) * (1.0f / (top - low)), T{}), all<T>(1.0f));
    const T up = 0.5f + 0.5f * s.place.normal.z;
    T through[3] = {};
    if (sun_on_ground(k.back))
        sun_through(
            k.back,
            depth_on_ground(k.back, b, Vec<T>{at.x, at.y, all<T>(k.back.ground_z)}, s.solid),
            through);
    for (int c = 0; c < 3; ++c) {
        const T below = scattered[c] + k.back.ground_sun[c] * (through[c] - 1.0f);
        out[c] = share * (up * scattered[c] * k.back.map_per_albedo + (1.0f - up) * below);
    }
}

/// Light on a surface at `at` from all around but the sun, over pi, as the nodes before it have it.
/// Returns how far it counts: 0 where no such node is known, less than 1 within a node of a face of
/// the box.
PILEUS_CALLED float light_of_nodes(const AroundNodes& a, bool on_ground, const float (&at)[3],
                                   const float (&normal)[3], float (&out)[3]) {
    constexpr float kBefore = 0.6f;  // nodes before the surface
    float h[3], step = 0, counts = 1;
    for (int i = 0; i < 3; ++i) {
        h[i] = at[i] * a.nodes.per_metre[i];
        step = larger(step, abs_(normal[i]) * a.nodes.per_metre[i]);
        if (a.periodic != 0 && i < 2) continue;
        if (!(i == 2 && on_ground)) counts = smaller(counts, h[i]);
        counts = smaller(counts, float(a.nodes.size[i]) - h[i]);
    }
    if (!(counts > 0.0f)) return 0;
    std::int32_t low[3];
    float share[3];
    for (int i = 0; i < 3; ++i) {
        const float p = h[i] + kBefore / step * normal[i] * a.nodes.per_metre[i] - 0.5f;
        low[i] = floor_int(p);
        share[i] = p - float(low[i]);
    }
    float whole = 0, k[3][kAroundTerms] = {};
    for (int corner = 0; corner < 8; ++corner) {
        std::int32_t p[3];
        float weight = 1, before = 0;
        for (int i = 0; i < 3; ++i) {
            const int far = corner >> i & 1;
            p[i] = low[i] + far;
            weight *= far != 0 ? share[i] : 1 - share[i];
            const std::int32_t n = a.nodes.size[i];
            const bool wraps = a.periodic != 0 && i < 2;
            if (!wraps) p[i] = p[i] < 0 ? 0 : p[i] >= n ? n - 1 : p[i];
            before += (float(p[i]) + 0.5f - h[i]) * normal[i] / a.nodes.per_metre[i];
            if (wraps) p[i] = (p[i] % n + n) % n;
        }
        const std::int32_t node =
            a.number[(std::int64_t(p[2]) * a.nodes.size[1] + p[1]) * a.nodes.size[0] + p[0]];
        if (node < 0 || !(before > 0.0f)) continue;
        whole += weight;
        for (int c = 0; c < 3; ++c)
            for (int m = 0; m < kAroundTerms; ++m)
                k[c][m] += weight * a.light[(c * kAroundTerms + m) * std::int64_t(a.count) + node];
    }
    if (!(whole > 1e-3f)) return 0;
    const Vec<float> n{normal[0], normal[1], normal[2]};
    for (int c = 0; c < 3; ++c) out[c] = around_light(k[c], n) / whole;
    return smaller(counts, 1);
}

/// In place of light from all around, where nodes tell it.
template <class T>
PILEUS_FN void around_from_nodes(const SolidRowsParams& k, const BackgroundBuffers& b,
                                 const LitSurface<T>& s, T (&around)[3]) {
    const bool on_ground =
        k.back.ground != 0 && k.back.ground_z * b.around.nodes.per_metre[2] > -0.5f;
    for (int i = 0; i < width_of<T>; ++i) {
        if ((bits_of(s.solid) >> i & 1u) == 0) continue;
        const float at[3] = {lane(s.place.at.x, i), lane(s.place.at.y, i), lane(s.place.at.z, i)};
        const float normal[3] = {lane(s.place.normal.x, i), lane(s.place.normal.y, i),
                                 lane(s.place.normal.z, i)};
        float light[3] = {};
        const float counts = light_of_nodes(b.around, on_ground, at, normal, light);
        for (int c = 0; c < 3; ++c)
            set_lane(around[c], i, lane(around[c], i) + counts * (light[c] - lane(around[c], i)));
    }
}

/// Radiance of what the rays meet, channel by channel.
template <class T>
PILEUS_FN void surface_light(const SolidRowsParams& k, const BackgroundBuffers& b,
                             const Ray<T>& ray, const LitSurface<T>& s, T (&out)[3]) {
    T scattered[3] = {}, changed[3] = {};
    const bool known = k.back.map.size[0] > 0;
    if (known && any(s.ground))
        scattered_on_ground(k.back, b, along(ray, select(s.ground, s.depth, T{})), scattered);
    if (known && k.back.map_per_albedo > 0.0f && any(s.solid)) {
        T below[3];
        scattered_on_ground(k.back, b, s.place.at, below);
        changed_around(k, b, s, below, changed);
    }
    Vec<T> sky{all<T>(k.back.sky[0]), all<T>(k.back.sky[1]), all<T>(k.back.sky[2])};
    if (k.back.sky_map.columns > 0) sky = map_radiance(k.back.sky_map, ray.direction);
    const T above[3] = {sky.x, sky.y, sky.z};
    T around[3];
    for (int c = 0; c < 3; ++c)
        around[c] = max_(around_light(k.around[c], s.place.normal) + changed[c], T{});
    if (b.around.count > 0) around_from_nodes(k, b, s, around);
    T ground[3];
    ground_light(k.back, ray, s.depth, s.ground, s.sunlight, scattered, ground);
    for (int c = 0; c < 3; ++c) {
        const T sun =
            k.sun_heights.rows != 0 ? sun_at(k.sun_heights, s.place.at.z, c) : all<T>(k.sun[c]);
        const T solid = s.place.albedo[c] * (around[c] + sun * s.sunlight[c]);
        out[c] = select(s.solid, solid, select(s.ground, ground[c], above[c]));
    }
}

/// Share of the sun's light that solids and media keep from what rays meet; 0 in the sky.
template <int W>
PILEUS_FN void shadow_of_rows(const SolidRowsParams& k, const BackgroundBuffers& b,
                              std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    // Before the surface, so that it does not shade itself where it is lit.
    constexpr float kBefore = 1 - 2e-5f;
    const CameraParams& camera = k.back.camera;
    const Vec<T> to_sun{all<T>(k.back.to_sun[0]), all<T>(k.back.to_sun[1]),
                        all<T>(k.back.to_sun[2])};
    for (std::uint32_t y = begin; y < end; ++y) {
        const std::int64_t row = std::int64_t(y) * camera.width;
        for (std::int32_t x = 0; x < camera.width; x += W) {
            const I<W> column = iota<I<W>>() + x;
            T depth = all<T>(__builtin_inff());
            for (int l = 0; l < W && x + l < camera.width; ++l)
                set_lane(depth, l, b.opaque_depth[row + x + l]);
            const M<W> met = depth < 3e38f;
            const Ray<T> ray = camera_ray(camera, to_float(column), all<T>(float(y)));
            const Vec<T> at = along(ray, select(met, depth * kBefore, T{}));
            M<W> lit = met;
            const T tau = depth_to_sun(k, at, to_sun, lit);
            const T dark = select(met, 1.0f - select(lit, exp_(T{} - tau), T{}), T{});
            for (int l = 0; l < W && x + l < camera.width; ++l)
                b.shadow[row + x + l] = lane(dark, l);
        }
    }
}

/// Radiance and distance of what rays meet; where there is room for it, its shadow alone.
template <int W>
PILEUS_FN void solid_rows(const SolidRowsParams& k, const BackgroundBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    using T = F<W>;
    if (b.shadow != nullptr) return shadow_of_rows<W>(k, b, begin, end);
    const CameraParams& camera = k.back.camera;
    const std::int64_t pixels = std::int64_t(camera.width) * camera.height;
    for (std::uint32_t y = begin; y < end; ++y) {
        for (std::int32_t x = 0; x < camera.width; x += W) {
            const I<W> column = iota<I<W>>() + x;
            const Ray<T> ray = camera_ray(camera, to_float(column), all<T>(float(y)));
            const LitSurface<T> s =
                find_surface<T>(k, ray, column < camera.width, b.colour != nullptr);
            T light[3] = {};
            if (b.colour != nullptr) surface_light(k, b, ray, s, light);
            for (int l = 0; l < W && x + l < camera.width; ++l) {
                const std::int64_t pixel = std::int64_t(y) * camera.width + x + l;
                if (b.opaque_depth != nullptr) b.opaque_depth[pixel] = lane(s.depth, l);
                for (int c = 0; c < 3 && b.colour != nullptr; ++c)
                    b.colour[c * pixels + pixel] = lane(light[c], l);
            }
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
