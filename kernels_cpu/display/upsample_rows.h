// SPDX-License-Identifier: Apache-2.0
// Rows of a picture from a lattice of marched pixels and from the picture before.
// in: UpsampleParams, UpsampleBuffers -> out: planes of the whole picture, pixels kept per row.
// docs/upsampling.md
#pragma once
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/upsample.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Where a place was in the picture before: pixels, and its distance; `seen`: within its frame.
template <class T>
struct SeenBefore {
    T x, y, distance;
    M_of<T> seen;
};
template <class T>
PILEUS_FN SeenBefore<T> seen_before(const CameraParams& c, const Vec<T>& place) {
    const Vec<T> v{place.x - c.origin[0], place.y - c.origin[1], place.z - c.origin[2]};
    const auto part = [&](const float(&axis)[3]) {
        return v.x * axis[0] + v.y * axis[1] + v.z * axis[2];
    };
    const T ahead = part(c.forward);
    const T depth = c.orthographic != 0 ? all<T>(1.0f) : max_(ahead, all<T>(1e-6f));
    SeenBefore<T> s;
    s.x = (part(c.right) / (depth * c.half_width) - c.shift_x / c.half_width + 1.0f) *
              (0.5f * float(c.width)) -
          0.5f;
    s.y = (1.0f - part(c.up) / (depth * c.half_height) + c.shift_y / c.half_height) *
              (0.5f * float(c.height)) -
          0.5f;
    s.distance = c.orthographic != 0 ? ahead : sqrt_(dot(v, v));
    s.seen = (ahead > 0.0f) & (s.x >= 0.0f) & (s.y >= 0.0f) & (s.x <= float(c.width - 1)) &
             (s.y <= float(c.height - 1));
    return s;
}

/// Distance at which the medium shows: where half of it lies before, or else in the box's middle.
template <class T>
PILEUS_FN T shown_at(const UpsampleParams& k, const UpsampleBuffers& b, const Around<T>& a,
                     const Ray<T>& ray, T opaque) {
    const T half = heaviest(b.half_depth, a);
    const Segment<T> box = clip_to_medium(k.medium, ray);
    const T middle = 0.5f * (box.enter + min_(max_(box.leave, box.enter), opaque));
    return select(half < 1e30f, half, middle);
}

/// The picture before at a pixel of it or between some.
template <class T>
PILEUS_FN Around<T> around_before(const CameraParams& c, T x, T y) {
    return around(PixelLattice{1, {0, 0}, c.width, c.height}, x, y, false);
}
template <class T>
PILEUS_FN void read_before(const UpsampleParams& k, const UpsampleBuffers& b, const Around<T>& p,
                           PixelLight<T>& light) {
    const std::int64_t pixels = std::int64_t(k.before.width) * k.before.height;
    light.value[0] = blended(b.before_transmittance, p);
    for (int i = 0; i < 3; ++i) light.value[1 + i] = blended(b.before_colour + i * pixels, p);
}

/// The same where a place was then, if it shows what lies there; false lanes have nothing of use.
template <class T>
PILEUS_FN M_of<T> recall(const UpsampleParams& k, const UpsampleBuffers& b, const Around<T>& a,
                         const Ray<T>& ray, T opaque, PixelLight<T>& light) {
    const CameraParams& c = k.before;
    const T far = shown_at(k, b, a, ray, opaque);
    const SeenBefore<T> s = seen_before(c, along(ray, far));
    auto good = s.seen;
    const T x = select(s.seen, s.x, T{}), y = select(s.seen, s.y, T{});
    const Around<T> p = around_before(c, x, y);
    if (b.before_opaque != nullptr) {
        // What stood behind must stand there still, as seen from the other camera.
        const SeenBefore<T> solid = seen_before(c, along(ray, min_(opaque, all<T>(1e18f))));
        const T then = heaviest(b.before_opaque, p);
        const T now = select(opaque < 1e18f, solid.distance, opaque);
        good = good & (depth_gap(then, now) < 0.05f);
    }
    read_before(k, b, p, light);
    return good;
}

/// Those of `filled` from the marched pixels around, or from the picture before.
template <int W>
PILEUS_FN void fill_pixels(const UpsampleParams& k, const UpsampleBuffers& b, Around<F<W>>& a,
                           F<W> column, F<W> row, F<W> opaque, M<W> filled, PixelLight<F<W>>& light,
                           F<W>& half, F<W>& depth, std::int32_t y) {
    using T = F<W>;
    const std::int64_t few = std::int64_t(k.lattice.width) * k.lattice.height;
    if (k.rule == kUpsampleDepth && b.opaque_depth != nullptr) weigh_depths(b, opaque, a);
    for (int i = 0; i < 4; ++i) {
        const float* plane = i == 0 ? b.transmittance : b.colour + (i - 1) * few;
        light.value[i] = select(filled, blended(plane, a), light.value[i]);
    }
    if (b.whole_half != nullptr) half = select(filled, heaviest(b.half_depth, a), half);
    if (b.whole_depth != nullptr) depth = select(filled, blended(b.ray_depth, a), depth);
    if (k.remembers == 0) return;
    PixelLight<T> old;
    auto good = filled & lnot(a.marched);
    if (k.still != 0)
        read_before(k, b, around_before(k.before, column, row), old);
    else
        good = good & recall(k, b, a, camera_ray(k.camera, column, row), opaque, old);
    for (int i = 0; i < 4; ++i) {
        const float* plane = i == 0 ? b.transmittance : b.colour + (i - 1) * few;
        if (k.still == 0) clamp_around(plane, a, old.value[i]);
        light.value[i] = select(good, old.value[i], light.value[i]);
    }
    b.kept[y] += count_bits(bits_of(good));
}

/// Light and depths of W pixels.
template <class T>
struct Filled {
    PixelLight<T> light;
    T half, depth;
};

/// W pixels of a row from column x on, before solids at `opaque`.
template <int W>
PILEUS_FN Filled<F<W>> upsample_lanes(const UpsampleParams& k, const UpsampleBuffers& b,
                                      std::int32_t x, std::int32_t y, std::int32_t real,
                                      F<W> opaque) {
    using T = F<W>;
    const std::int64_t few = std::int64_t(k.lattice.width) * k.lattice.height;
    const T column = min_(to_float(iota<I<W>>() + x), all<T>(float(k.camera.width - 1)));
    const T row = all<T>(float(y));
    Around<T> a = around(k.lattice, column, row, k.rule == kUpsampleNearest);
    find_close(k.lattice, a);
    // Among pixels without medium one is as they are, whatever was there before.
    const M<W> within = iota<I<W>>() < real;
    M<W> clear = shows_nothing(b, few, a);
    if (k.still != 0) clear = clear & a.marched;
    Filled<T> out{};
    out.light.value[0] = all<T>(1.0f);
    out.half = all<T>(__builtin_inff());
    const M<W> filled = within & lnot(clear);
    if (any(filled))
        fill_pixels<W>(k, b, a, column, row, opaque, filled, out.light, out.half, out.depth, y);
    return out;
}

template <int W>
PILEUS_FN void upsample_pixels(const UpsampleParams& k, const UpsampleBuffers& b, std::int32_t x,
                               std::int32_t y) {
    using T = F<W>;
    const std::int32_t width = k.camera.width, real = width - x < W ? width - x : W;
    const std::int64_t pixels = std::int64_t(width) * k.camera.height;
    const std::int64_t first = std::int64_t(y) * width + x;
    T opaque = all<T>(__builtin_inff());
    if (b.whole_opaque != nullptr) opaque = take_lanes<T>(b.whole_opaque + first, real);
    const Filled<T> out = upsample_lanes<W>(k, b, x, y, real, opaque);
    put_lanes(out.light.value[0], b.whole_transmittance + first, real);
    for (int i = 0; i < 3; ++i)
        put_lanes(out.light.value[1 + i], b.whole_colour + i * pixels + first, real);
    if (b.whole_half != nullptr) put_lanes(out.half, b.whole_half + first, real);
    if (b.whole_depth != nullptr) put_lanes(out.depth, b.whole_depth + first, real);
}

template <int W>
PILEUS_FN void upsample_rows(const UpsampleParams& k, const UpsampleBuffers& b, std::uint32_t begin,
                             std::uint32_t end) {
    for (std::uint32_t y = begin; y < end; ++y)
        for (std::int32_t x = 0; x < k.camera.width; x += W)
            upsample_pixels<W>(k, b, x, std::int32_t(y));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
