// SPDX-License-Identifier: Apache-2.0
// What lies behind the media: sky and ground, with the media's shadow and light upon it.
// in: density, majorants, the map of scattered light -> out: planes of pixels.
// docs/collectors.md, "Light that needs no photon"; docs/formats.md, "Pictures out".
#pragma once
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/light/ground.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What interpolate() gives in a grid one cell high that does not wrap: both slices are the same.
/// Adding zero gives a zero the sign that mixing them does.
template <class T>
PILEUS_FN T interpolate_flat(const float* grid, const Corners<T>& c, std::int32_t width) {
    if constexpr (kGathersPairs<width_of<T>>) {
        if (width > 1) return row_pairs(grid, c, c.y0, c.y1, width) + T{};
    }
    const auto between = [](T a, T b, T f) { return a + (b - a) * f; };
    const T low = between(gather(grid, c.y0 + c.x0), gather(grid, c.y0 + c.x1), c.fx);
    return between(low, between(gather(grid, c.y1 + c.x0), gather(grid, c.y1 + c.x1), c.fx), c.fy) +
           T{};
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
    for (int i = 0; i < 3; ++i)
        radiance[i] = select(known,
                             wraps ? interpolate(b.map + i * cells, c)
                                   : interpolate_flat(b.map + i * cells, c, k.map.size[0]),
                             T{});
}

/// Optical depth towards the sun at a place on the ground, between nodes. Those of the rim have
/// none, so that there is none beyond them.
template <class T>
PILEUS_FN T shadow_on_ground(const BackgroundParams& k, const BackgroundBuffers& b,
                             const Vec<T>& at) {
    const Vec<T> p{(at.x - k.shadow_origin[0]) * k.shadow.per_metre[0],
                   (at.y - k.shadow_origin[1]) * k.shadow.per_metre[1], all<T>(0.5f)};
    return interpolate_flat(b.ground_depth, corners(p, k.shadow.size, false), k.shadow.size[0]);
}

/// Shares of sunlight that come through an optical depth to surfaces, by channel.
template <class T>
PILEUS_FN void sun_through(const BackgroundParams& k, T tau, T (&out)[3]) {
    for (int c = 0; c < 3; ++c)
        out[c] = c > 0 && k.sun_rest[c] == k.sun_rest[0] ? out[0] : exp_(T{} - tau * k.sun_rest[c]);
}

/// Whether the sun lights the ground, and the optical depth towards it, of the lanes of `wanted`.
PILEUS_FN bool sun_on_ground(const BackgroundParams& k) {
    return k.ground_sun[0] > 0.0f || k.ground_sun[1] > 0.0f || k.ground_sun[2] > 0.0f;
}
template <class T>
PILEUS_FN T depth_on_ground(const BackgroundParams& k, const BackgroundBuffers& b, const Vec<T>& at,
                            M_of<T> wanted) {
    if (k.shadow.size[0] > 0) return shadow_on_ground(k, b, at);
    const Vec<T> to_sun{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    return optical_depth(k.medium, Ray<T>{at, to_sun}, wanted);
}

/// Radiance of the ground along rays that meet it: of `sunlight` what arrives of the sun's,
/// `scattered` by media.
template <class T>
PILEUS_FN void ground_light(const BackgroundParams& k, const Ray<T>& ray, T depth, M_of<T> ground,
                            const T (&sunlight)[3], const T (&scattered)[3], T (&out)[3]) {
    if (!is_painted(k.paint) || !any(ground)) {
        for (int c = 0; c < 3; ++c)
            out[c] = k.ground_diffuse[c] + k.ground_sun[c] * sunlight[c] + scattered[c];
        return;
    }
    T diffuse[3];
    for (int c = 0; c < 3; ++c) diffuse[c] = k.ground_diffuse[c] + scattered[c];
    const T way = select(ground, depth, T{});
    painted_ground(k.paint, along(ray, way), ray.direction,
                   k.camera.orthographic != 0 ? all<T>(1.0f) : way, diffuse, k.ground_sun, sunlight,
                   k.to_sun, out);
}

/// What W pixels show behind the media, and how far it is; infinity for the sky.
template <class T>
struct Behind {
    T depth, colour[3];
};

/// Sky, or a Lambertian ground with the clouds' shadow of the sun, of W pixels from column x on.
/// Without `coloured` the depth alone.
template <int W>
PILEUS_FN Behind<F<W>> background_lanes(const BackgroundParams& k, const BackgroundBuffers& b,
                                        std::int32_t x, std::int32_t y, bool coloured) {
    using T = F<W>;
    const I<W> column = iota<I<W>>() + x;
    const Ray<T> ray = camera_ray(k.camera, to_float(column), all<T>(float(y)));
    Behind<T> out{};
    out.depth = all<T>(__builtin_inff());
    T sunlight[3] = {};
    M<W> ground = column < 0;
    if (k.ground != 0) {
        const T height = ray.origin.z - k.ground_z;
        ground = (ray.direction.z < 0.0f) & (height >= 0.0f) & (column < k.camera.width);
        out.depth = select(ground, height / max_(T{} - ray.direction.z, all<T>(1e-18f)), out.depth);
        if (coloured && sun_on_ground(k) && any(ground))
            sun_through(k,
                        depth_on_ground(k, b, along(ray, select(ground, out.depth, T{})), ground),
                        sunlight);
    }
    if (!coloured) return out;
    T scattered[3] = {};
    if (k.map.size[0] > 0 && any(ground))
        scattered_on_ground(k, b, along(ray, select(ground, out.depth, T{})), scattered);
    Vec<T> sky{all<T>(k.sky[0]), all<T>(k.sky[1]), all<T>(k.sky[2])};
    if (k.sky_map.columns > 0) sky = map_radiance(k.sky_map, ray.direction);
    const T above[3] = {sky.x, sky.y, sky.z};
    T below[3];
    ground_light(k, ray, out.depth, ground, sunlight, scattered, below);
    for (int c = 0; c < 3; ++c) out.colour[c] = select(ground, below[c], above[c]);
    return out;
}

template <int W>
PILEUS_FN void background_rows(const BackgroundParams& k, const BackgroundBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    const std::int64_t pixels = std::int64_t(k.camera.width) * k.camera.height;
    for (std::uint32_t y = begin; y < end; ++y) {
        for (std::int32_t x = 0; x < k.camera.width; x += W) {
            const Behind<F<W>> behind =
                background_lanes<W>(k, b, x, std::int32_t(y), b.colour != nullptr);
            const std::int64_t first = std::int64_t(y) * k.camera.width + x;
            const std::int32_t real = k.camera.width - x < W ? k.camera.width - x : W;
            if (b.opaque_depth != nullptr) put_lanes(behind.depth, b.opaque_depth + first, real);
            for (int c = 0; c < 3 && b.colour != nullptr; ++c)
                put_lanes(behind.colour[c], b.colour + c * pixels + first, real);
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
