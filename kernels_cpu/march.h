// SPDX-License-Identifier: Apache-2.0
// Marching: sunlight's optical depth per node, the picture per pixel, ground and sky behind it.
// in: density, majorants, lit node grids -> out: planes of pixels or nodes.
// docs/methods.md 3, repair 4, and 4 (closed form per step: S (1 - e^-sigma dt) / sigma).
// Samples sit on a lattice along each ray; skipping empty blocks leaves out zeros only. Through a
// periodic medium rays run on unbent; what they read is reduced to one period.
#pragma once
#include "kernels_cpu/march_params.h"
#include "kernels_cpu/medium.h"
#include "kernels_cpu/sh.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN Vec<T> along(const Ray<T>& r, T t) {
    return {r.origin.x + r.direction.x * t, r.origin.y + r.direction.y * t,
            r.origin.z + r.direction.z * t};
}

/// Bound on the density around `p` (voxels), and metres from there to the end of its block.
template <class T>
struct Block {
    T bound, rest;
};
template <class T>
PILEUS_FN Block<T> block_ahead(const MediumView& m, const Vec<T>& p, const Vec<T>& d) {
    using II = I_of<T>;
    const auto index = [&](T v, int axis) {
        return min_(max_(to_int(v * (1.0f / m.block)), II{}), all<II>(m.blocks[axis] - 1));
    };
    const II x = index(p.x, 0), y = index(p.y, 1), z = index(p.z, 2);
    const auto rest = [&](II i, T v, T direction, int axis) {
        const auto forward = direction >= 0.0f;
        // The grid may end within its last block; behind it the next period's begins.
        const T face =
            min_(to_float(select(forward, i + 1, i)) * m.block, all<T>(float(m.size[axis])));
        const T safe = max_(abs_(direction), all<T>(1e-18f));
        return select(forward, face - v, v - face) * m.cell[axis] / safe;
    };
    const T t = min_(min_(rest(x, p.x, d.x, 0), rest(y, p.y, d.y, 1)), rest(z, p.z, d.z, 2));
    return {gather(m.majorant, (z * m.blocks[1] + y) * m.blocks[0] + x), max_(t, T{})};
}

/// Shortest step as a share of the ray in the box: grids have at most 4096 cells along an axis, so
/// that a ray still takes two steps or more in each cell it crosses.
constexpr float kLeastStep = 0x1p-13f;

/// Most steps of a ray through a periodic medium: a level ray would see no end of it.
constexpr float kMostPeriodicSteps = 0x1p17f;

/// Where a ray enters and leaves the medium's box, or the layer that a periodic one is.
template <class T>
PILEUS_FN Segment<T> clip_to_medium(const MediumView& m, const Ray<T>& ray) {
    if (m.periodic == 0) return clip_to_box(ray.origin, ray.direction, m.extent);
    Segment<T> s = clip_to_layer(ray.origin.z, ray.direction.z, m.extent[2]);
    s.leave = min_(s.leave, s.enter + kMostPeriodicSteps * m.step);
    return s;
}

/// Metres within the box, or within the period that holds them.
template <class T>
PILEUS_FN Vec<T> reduced(const MediumView& m, const Vec<T>& q) {
    if (m.periodic == 0) return q;
    return {wrap_place(q.x, m.extent[0]), wrap_place(q.y, m.extent[1]), q.z};
}

/// Visits the middles of steps that start at enter + n step; the last one ends at `leave`.
/// `sample(dense, t, width, voxel position, metres)`, both places within one period, may return
/// lanes that are finished.
template <class T, class Sample>
PILEUS_FN void march_ray(const MediumView& m, const Ray<T>& ray, T enter, T leave, Sample sample) {
    T n{};
    auto alive = enter < leave;
    // A flat voxel sets the step for rays along it, too: bound their number (docs/testing.md S41).
    const float least = m.periodic != 0 ? 1.0f / kMostPeriodicSteps : kLeastStep;
    const T step = max_(all<T>(m.step), (leave - enter) * least), per_metre = 1.0f / step;
    // Bounded: every turn of the loop advances every living lane by a step.
    while (any(alive)) {
        const T start = enter + n * step;
        const T width = max_(min_(step, leave - start), T{});
        const T t = start + 0.5f * width;
        const Vec<T> q = reduced(m, along(ray, t));
        const Vec<T> p{q.x * (1.0f / m.cell[0]), q.y * (1.0f / m.cell[1]),
                       q.z * (1.0f / m.cell[2])};
        const Block<T> block = block_ahead(m, p, ray.direction);
        const auto dense = alive & (block.bound > 0.0f);
        const auto ended = sample(dense, t, width, p, q);
        // Jump to the last step whose middle lies in an empty block; it adds nothing either.
        const T skipped = to_float(to_int(min_(block.rest * per_metre, all<T>(1e6f))));
        n = select(dense, n + 1.0f, n + max_(skipped, all<T>(1.0f)));
        alive = alive & lnot(dense & ended) & (enter + n * step < leave);
    }
}

/// Optical depth from `origin` along `direction` to the end of the box.
template <class T>
PILEUS_FN T optical_depth(const MediumView& m, const Ray<T>& ray, M_of<T> wanted) {
    const Segment<T> box = clip_to_medium(m, ray);
    const T leave = select(wanted, box.leave, box.enter);
    T sum{};
    march_ray(m, ray, box.enter, leave,
              [&](M_of<T> dense, T, T width, const Vec<T>& p, const Vec<T>&) {
                  if (any(dense)) {
                      const Corners<T> at = corners(p, m.size, m.periodic != 0);
                      sum = select(dense, sum + width * interpolate(m.density, at), sum);
                  }
                  return sum * m.sigma > 60.0f;  // e^-60 is nothing
              });
    return sum * m.sigma;
}

/// Rows of nodes [begin, end), a row along x.
template <int W>
PILEUS_FN void shadow_rows(const ShadowParams& k, const ShadowBuffers& b, std::uint32_t begin,
                           std::uint32_t end) {
    using T = F<W>;
    const std::int32_t nx = k.nodes.size[0], ny = k.nodes.size[1];
    const Vec<T> d{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    for (std::uint32_t row = begin; row < end; ++row) {
        const float y = (float(std::int32_t(row) % ny) + 0.5f) / k.nodes.per_metre[1];
        const float z = (float(std::int32_t(row) / ny) + 0.5f) / k.nodes.per_metre[2];
        for (std::int32_t x = 0; x < nx; x += W) {
            const I<W> i = iota<I<W>>() + x;
            const T px = (to_float(i) + 0.5f) / k.nodes.per_metre[0];
            const Ray<T> ray{{px, all<T>(y), all<T>(z)}, d};
            const T tau = optical_depth(k.medium, ray, i < nx);
            for (int l = 0; l < W && x + l < nx; ++l)
                b.optical_depth[std::int64_t(row) * nx + x + l] = lane(tau, l);
        }
    }
}

template <class T>
PILEUS_FN Vec<T> node_position(const NodeGrid& g, const Vec<T>& metres) {
    return {metres.x * g.per_metre[0], metres.y * g.per_metre[1], metres.z * g.per_metre[2]};
}

/// The sun's first order along one ray, per unit of the sunlight that arrives.
template <class T>
struct SunAlongRay {
    T phase[kMostMedia];
    bool lit;
};
template <class T>
PILEUS_FN SunAlongRay<T> sun_along(const MarchParams& k, const Vec<T>& direction) {
    SunAlongRay<T> s{};
    const Vec<T> sun{all<T>(k.sun_travel[0]), all<T>(k.sun_travel[1]), all<T>(k.sun_travel[2])};
    const T turn =
        one_minus_cosine(sun, Vec<T>{T{} - direction.x, T{} - direction.y, T{} - direction.z});
    for (int i = 0; i < kMostMedia && i < k.media; ++i) {
        s.phase[i] = phase_density(k.phase[i], turn);
        for (int c = 0; c < 3; ++c) s.lit |= k.sun_source[i][c] > 0.0f;
    }
    return s;
}

/// The same where the sunlight is `light`: by the share of each medium in the `density` there.
template <class T>
PILEUS_FN void sun_source_at(const MarchParams& k, const MarchBuffers& b, const SunAlongRay<T>& s,
                             const Corners<T>& at, T density, T light, T (&source)[3]) {
    if (k.media <= 1) {
        const T direct = s.phase[0] * light;
        for (int c = 0; c < 3; ++c) source[c] = direct * k.sun_source[0][c];
        return;
    }
    const std::int32_t* n = k.medium.size;
    for_shares(
        b.parts, std::int64_t(n[0]) * n[1] * n[2], k.media, density,
        [&](const float* grid) { return interpolate(grid, at); },
        [&](int i, T share) {
            const T direct = share * s.phase[i] * light;
            for (int c = 0; c < 3; ++c) source[c] = source[c] + direct * k.sun_source[i][c];
        });
}

/// The harmonics of the directions in which a ray's light travels, lane by lane.
template <int W>
struct RayHarmonics {
    float y[W][kMostHarmonics];
};
template <int W>
PILEUS_FN void set_harmonics(const MarchParams& k, const Vec<F<W>>& d, RayHarmonics<W>& h) {
    F<W> y[kMaxBands * kMaxBands];
    sh_values(k.bands, Vec<F<W>>{F<W>{} - d.x, F<W>{} - d.y, F<W>{} - d.z}, y);
    for (int l = 0; l < W; ++l)
        for (int i = 0; i < k.harmonics; ++i)
            h.y[l][i] = i < k.bands * k.bands ? lane(y[i], l) : 0.0f;
}

/// Light of each set that leaves a place along directions with harmonics `y`. Numbers of one node
/// lie side by side and are added up sixteen abreast, in an order that no width changes.
template <class T>
PILEUS_FN void light_along(const MarchParams& k, const float* source, const Corners<T>& c, int l,
                           const float* y, float (&out)[3]) {
    const float fx = lane(c.fx, l), fy = lane(c.fy, l), fz = lane(c.fz, l);
    const std::int32_t xs[2] = {lane(c.x0, l), lane(c.x1, l)};
    const std::int32_t ys[2] = {lane(c.y0, l), lane(c.y1, l)};
    const std::int32_t zs[2] = {lane(c.z0, l), lane(c.z1, l)};
    const float wx[2] = {1.0f - fx, fx}, wy[2] = {1.0f - fy, fy}, wz[2] = {1.0f - fz, fz};
    const int numbers = k.sets * k.harmonics;
    float sum[3 * kMostHarmonics];
    for (int i = 0; i < numbers; ++i) sum[i] = 0;
    for (int j = 0; j < 8; ++j) {
        const float weight = wx[j & 1] * wy[(j >> 1) & 1] * wz[j >> 2];
        const std::int64_t node = zs[j >> 2] + ys[(j >> 1) & 1] + xs[j & 1];
        const float* from = source + node * numbers;
        for (int i = 0; i < numbers; ++i) sum[i] = sum[i] + weight * from[i];
    }
    for (int s = 0; s < k.sets; ++s) {
        float part[kHarmonicsAbreast] = {};
        const float* own = sum + s * k.harmonics;
        for (int i = 0; i < k.harmonics; i += kHarmonicsAbreast)
            for (int j = 0; j < kHarmonicsAbreast; ++j) part[j] = part[j] + y[i + j] * own[i + j];
        for (int half = kHarmonicsAbreast / 2; half > 0; half /= 2)
            for (int j = 0; j < half; ++j) part[j] = part[j] + part[j + half];
        out[s] = part[0];
    }
}

/// Adds `weight` times all light that leaves towards the camera: `direct` and that of the nodes.
template <int W>
PILEUS_FN void add_source(const MarchParams& k, const MarchBuffers& b, const Vec<F<W>>& metres,
                          const RayHarmonics<W>& h, const F<W> (&direct)[3], F<W> weight,
                          F<W>* colour) {
    using T = F<W>;
    const Corners<T> c =
        corners(node_position(k.source, metres), k.source.size, k.medium.periodic != 0);
    const std::int64_t nodes = std::int64_t(k.source.size[0]) * k.source.size[1] * k.source.size[2];
    if (k.bands == 0) {
        for (int i = 0; i < k.channels; ++i) {
            T source = interpolate(b.source + i * nodes, c);
            source = source + (direct[i % 3] + k.constant[i % 3]);
            colour[i] = colour[i] + weight * source;
        }
        return;
    }
    T source[3];
    for (int i = 0; i < 3; ++i) source[i] = direct[i] + k.constant[i];
    for (std::uint32_t lanes = bits_of(weight > 0.0f); lanes != 0; lanes &= lanes - 1) {
        const int l = lowest_bit(lanes);
        float light[3] = {};
        light_along(k, b.source, c, l, h.y[l], light);
        for (int s = 0; s < k.sets; ++s)
            for (int i = 0; i < 3; ++i)
                set_lane(source[i], l, lane(source[i], l) + light[s] * k.set_colour[s][i]);
    }
    for (int i = 0; i < 3; ++i) colour[i] = colour[i] + weight * source[i];
}

/// Lanes hold a block of pixels, so many of each row: its rays stay together longer than a row's.
template <int W>
constexpr int kMarchAcross = W >= 8   ? 4
                             : W >= 4 ? 2
                                      : 1;

/// Calls function(lane, pixel) for the lanes of a block from (x, y) on that lie in the picture,
/// above row `end`.
template <int W, class Function>
PILEUS_FN void for_block(const CameraParams& c, std::int32_t x, std::int32_t y, std::int32_t end,
                         Function function) {
    constexpr int across = kMarchAcross<W>;
    for (int l = 0; l < W; ++l)
        if (x + l % across < c.width && y + l / across < end)
            function(l, std::int64_t(y + l / across) * c.width + x + l % across);
}

/// W pixels, a block from column x and row y on, in rows before `end`.
template <int W>
PILEUS_FN void march_pixels(const MarchParams& k, const MarchBuffers& b, std::int32_t x,
                            std::int32_t y, std::int32_t end) {
    using T = F<W>;
    constexpr int kMost = 3 * 17;
    const I<W> number = iota<I<W>>();
    const I<W> column = number % kMarchAcross<W> + x, row = number / kMarchAcross<W> + y;
    const M<W> real = (column < k.camera.width) & (row < end);
    const std::int64_t pixels = std::int64_t(k.camera.width) * k.camera.height;

    const Ray<T> ray = camera_ray(k.camera, to_float(column), to_float(row));
    const Segment<T> box = clip_to_medium(k.medium, ray);
    T leave = box.leave;
    if (b.opaque_depth != nullptr) {
        T opaque{};
        for_block<W>(k.camera, x, y, end, [&](int l, std::int64_t pixel) {
            set_lane(opaque, l, b.opaque_depth[pixel]);
        });
        leave = min_(leave, opaque);
    }
    leave = select(real, leave, box.enter);

    const SunAlongRay<T> sun = sun_along(k, ray.direction);
    RayHarmonics<W> harmonics;
    if (k.bands > 0) set_harmonics(k, ray.direction, harmonics);
    const bool wraps = k.medium.periodic != 0;

    T transmittance = all<T>(1.0f), half = all<T>(__builtin_inff()), depth{};
    T colour[kMost];
    for (int c = 0; c < k.channels; ++c) colour[c] = T{};
    march_ray(
        k.medium, ray, box.enter, leave,
        [&](M<W> dense, T t, T width, const Vec<T>& p, const Vec<T>& metres) {
            if (!any(dense)) return transmittance < k.cut;
            const Corners<T> at = corners(p, k.medium.size, wraps);
            const T density = interpolate(k.medium.density, at);
            const T optical = select(dense, density * k.medium.sigma * width, T{});
            if (!any(optical > 0.0f)) return transmittance < k.cut;
            depth = depth + optical;
            const T alpha = one_minus_exp(optical);
            const T weight = transmittance * alpha;
            T direct[3] = {};
            if (sun.lit) {
                const Vec<T> node = node_position(k.shadow, metres);
                const T tau = interpolate(b.optical_depth, corners(node, k.shadow.size, wraps));
                sun_source_at(k, b, sun, at, density, exp_(T{} - tau), direct);
            }
            add_source<W>(k, b, metres, harmonics, direct, weight, colour);
            const T left = transmittance * (1.0f - alpha);
            if (b.half_depth != nullptr) {
                const auto crosses = (transmittance > 0.5f) & (left <= 0.5f);
                if (any(crosses)) {
                    const T share = log_(transmittance * 2.0f) / max_(optical, all<T>(1e-30f));
                    half = select(crosses, t + (share - 0.5f) * width, half);
                }
            }
            transmittance = left;
            return transmittance < k.cut;
        });
    for_block<W>(k.camera, x, y, end, [&](int l, std::int64_t pixel) {
        b.transmittance[pixel] = lane(transmittance, l);
        if (b.half_depth != nullptr) b.half_depth[pixel] = lane(half, l);
        if (b.ray_depth != nullptr) b.ray_depth[pixel] = lane(depth, l);
        for (int c = 0; c < k.channels; ++c) b.colour[c * pixels + pixel] = lane(colour[c], l);
    });
}

template <int W>
PILEUS_FN void march_rows(const MarchParams& k, const MarchBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    constexpr int across = kMarchAcross<W>;
    for (std::uint32_t y = begin; y < end; y += W / across)
        for (std::int32_t x = 0; x < k.camera.width; x += across)
            march_pixels<W>(k, b, x, std::int32_t(y), std::int32_t(end));
}

/// Light that the cloud scatters onto the ground at `at`; nothing is known beyond the map, which
/// covers one period where there are periods.
template <class T>
PILEUS_FN void scattered_on_ground(const BackgroundParams& k, const BackgroundBuffers& b,
                                   const Vec<T>& at, T* radiance) {
    const Vec<T> place = reduced(k.medium, at);
    const Vec<T> p{(place.x - k.map_origin[0]) * k.map.per_metre[0],
                   (place.y - k.map_origin[1]) * k.map.per_metre[1], all<T>(0.5f)};
    const bool wraps = k.medium.periodic != 0;
    auto known = (p.x >= 0.0f) & (p.x <= float(k.map.size[0])) & (p.y >= 0.0f) &
                 (p.y <= float(k.map.size[1]));
    if (wraps) known = p.z > 0.0f;
    const Corners<T> c = corners(p, k.map.size, wraps);
    const std::int32_t cells = k.map.size[0] * k.map.size[1];
    for (int i = 0; i < 3; ++i) radiance[i] = select(known, interpolate(b.map + i * cells, c), T{});
}

/// What lies behind the media: sky, or a Lambertian ground with the clouds' shadow of the sun.
template <int W>
PILEUS_FN void background_rows(const BackgroundParams& k, const BackgroundBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const std::int64_t pixels = std::int64_t(k.camera.width) * k.camera.height;
    const Vec<T> to_sun{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    const bool sunlit = k.ground_sun[0] > 0.0f || k.ground_sun[1] > 0.0f || k.ground_sun[2] > 0.0f;
    for (std::uint32_t y = begin; y < end; ++y) {
        for (std::int32_t x = 0; x < k.camera.width; x += W) {
            const I<W> column = iota<I<W>>() + x;
            const Ray<T> ray = camera_ray(k.camera, to_float(column), all<T>(float(y)));
            T depth = all<T>(__builtin_inff()), sunlight{};
            M<W> ground = column < 0;
            if (k.ground != 0) {
                const T height = ray.origin.z - k.ground_z;
                ground = (ray.direction.z < 0.0f) & (height >= 0.0f) & (column < k.camera.width);
                depth = select(ground, height / max_(T{} - ray.direction.z, all<T>(1e-18f)), depth);
                if (sunlit && any(ground)) {
                    const Ray<T> up{along(ray, select(ground, depth, T{})), to_sun};
                    sunlight = exp_(T{} - optical_depth(k.medium, up, ground));
                }
            }
            T scattered[3] = {};
            if (k.map.size[0] > 0 && any(ground))
                scattered_on_ground(k, b, along(ray, select(ground, depth, T{})), scattered);
            Vec<T> sky{all<T>(k.sky[0]), all<T>(k.sky[1]), all<T>(k.sky[2])};
            if (k.sky_map.columns > 0) sky = map_radiance(k.sky_map, ray.direction);
            const T above[3] = {sky.x, sky.y, sky.z};
            for (int l = 0; l < W && x + l < k.camera.width; ++l) {
                const std::int64_t pixel = std::int64_t(y) * k.camera.width + x + l;
                const bool hit = (bits_of(ground) >> l) & 1u;
                if (b.opaque_depth != nullptr) b.opaque_depth[pixel] = lane(depth, l);
                for (int c = 0; c < 3 && b.colour != nullptr; ++c)
                    b.colour[c * pixels + pixel] = hit ? k.ground_diffuse[c] +
                                                             k.ground_sun[c] * lane(sunlight, l) +
                                                             lane(scattered[c], l)
                                                       : lane(above[c], l);
            }
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
