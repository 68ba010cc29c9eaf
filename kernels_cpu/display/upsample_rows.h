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
              (0.5f * float(whole_width(c))) -
          (0.5f + float(c.left));
    s.y = (1.0f - part(c.up) / (depth * c.half_height) + c.shift_y / c.half_height) *
              (0.5f * float(whole_height(c))) -
          (0.5f + float(c.top));
    s.distance = c.orthographic != 0 ? ahead : sqrt_(dot(v, v));
    s.seen = (ahead > 0.0f) & (s.x >= 0.0f) & (s.y >= 0.0f) & (s.x <= float(c.width - 1)) &
             (s.y <= float(c.height - 1));
    return s;
}

/// A mean of distances by their inverses, to which a move across the view is proportional; what is
/// infinite is not known and does not count.
template <class T>
struct MeanWay {
    T inverses, weights;
};
template <class T>
PILEUS_FN void add_way(T metres, T weight, MeanWay<T>& mean) {
    const auto known = metres < 1e30f;
    mean.weights = mean.weights + select(known, weight, T{});
    mean.inverses = mean.inverses + select(known, weight / max_(metres, all<T>(1e-6f)), T{});
}

/// Distance at which the medium shows: where half of it lies before, a mean of the marched pixels
/// around; of more of them at rims, where it hides little; or else in the box's middle.
template <class T>
PILEUS_FN T shown_at(const UpsampleParams& k, const UpsampleBuffers& b, const Around<T>& a,
                     const Ray<T>& ray, T opaque) {
    const PixelLattice& g = k.lattice;
    MeanWay<T> mean{};
    // Those without weight count little, but where they alone are known they count.
    for (int i = 0; i < 4; ++i) add_way(gather(b.half_depth, a.at[i]), a.weight[i] + 1e-3f, mean);
    if (any(mean.weights <= 0.0f)) {
        MeanWay<T> wide{};
        auto nearest = a.at[0];
        for (int i = 1; i < 4; ++i) nearest = select(a.weight[i] >= 0.25f, a.at[i], nearest);
        const auto column = nearest % g.width, row = nearest / g.width;
        for (int i = 0; i < 9; ++i) {
            const auto x = max_(min_(column + (i % 3 - 1), all<I_of<T>>(g.width - 1)), I_of<T>{});
            const auto y = max_(min_(row + (i / 3 - 1), all<I_of<T>>(g.height - 1)), I_of<T>{});
            add_way(gather(b.half_depth, y * g.width + x), all<T>(1.0f), wide);
        }
        const auto none = mean.weights <= 0.0f;
        mean.weights = select(none, wide.weights, mean.weights);
        mean.inverses = select(none, wide.inverses, mean.inverses);
    }
    const Segment<T> box = clip_to_medium(k.medium, ray);
    const T middle = 0.5f * (box.enter + min_(max_(box.leave, box.enter), opaque));
    return select(mean.weights > 0.0f, mean.weights / max_(mean.inverses, all<T>(1e-30f)), middle);
}

/// The picture before at a pixel of it or between some.
template <class T>
PILEUS_FN Around<T> around_before(const CameraParams& c, T x, T y) {
    return around(PixelLattice{1, {0, 0}, c.width, c.height}, x, y, false);
}
/// Weights of four pixels in a row by Catmull and Rom's cubic, the place `t` behind the second.
template <class T>
PILEUS_FN void cubic_weights(T t, T (&w)[4]) {
    const T t2 = t * t, t3 = t2 * t;
    w[0] = t2 - 0.5f * (t3 + t);
    w[1] = 1.5f * t3 - 2.5f * t2 + 1.0f;
    w[2] = 0.5f * t + 2.0f * t2 - 1.5f * t3;
    w[3] = 0.5f * (t3 - t2);
}

/// Between pixels by cubics: bilinear look-ups, one after the other, would blur. Of 4 x 4 pixels
/// without the corners, whose weights are below a hundredth.
template <class T>
PILEUS_FN void read_before(const UpsampleParams& k, const UpsampleBuffers& b, T x, T y,
                           PixelLight<T>& light) {
    using I = I_of<T>;
    const std::int32_t width = k.before.width, height = k.before.height;
    const I x0 = floor_int(x), y0 = floor_int(y);
    T wx[4], wy[4], sum[4] = {}, weights{};
    cubic_weights(x - to_float(x0), wx);
    cubic_weights(y - to_float(y0), wy);
    for (int j = 0; j < 16; ++j) {
        const int i = j % 4, n = j / 4;
        if ((i == 0 || i == 3) && (n == 0 || n == 3)) continue;
        const I column = max_(min_(x0 + (i - 1), all<I>(width - 1)), I{});
        const I at = max_(min_(y0 + (n - 1), all<I>(height - 1)), I{}) * width + column;
        const T weight = wx[i] * wy[n];
        weights = weights + weight;
        sum[0] = sum[0] + weight * gather(b.before_transmittance, at);
        for (int c = 0; c < 3; ++c)
            sum[1 + c] = sum[1 + c] +
                         weight * gather(b.before_colour + c * std::int64_t(width) * height, at);
    }
    for (int i = 0; i < 4; ++i) light.value[i] = sum[i] / weights;
}

/// What stood at the same pixel, exactly.
template <class T>
PILEUS_FN void read_same(const UpsampleParams& k, const UpsampleBuffers& b, T x, T y,
                         PixelLight<T>& light) {
    const std::int64_t pixels = std::int64_t(k.before.width) * k.before.height;
    const auto at = to_int(y) * k.before.width + to_int(x);
    light.value[0] = gather(b.before_transmittance, at);
    for (int i = 0; i < 3; ++i) light.value[1 + i] = gather(b.before_colour + i * pixels, at);
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
    if (b.before_opaque != nullptr) {
        const Around<T> p = around_before(c, x, y);
        // What stood behind must stand there still, as seen from the other camera.
        const SeenBefore<T> solid = seen_before(c, along(ray, min_(opaque, all<T>(1e18f))));
        const T then = heaviest(b.before_opaque, p);
        const T now = select(opaque < 1e18f, solid.distance, opaque);
        good = good & (depth_gap(then, now) < 0.05f);
    }
    read_before(k, b, x, y, light);
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
        read_same(k, b, column, row, old);
    else
        good = good & recall(k, b, a, camera_ray(k.camera, column, row), opaque, old);
    for (int i = 0; i < 4; ++i) {
        const float* plane = i == 0 ? b.transmittance : b.colour + (i - 1) * few;
        if (k.still == 0) clamp_around(plane, a, i == 0 ? 1.0f : 3e38f, old.value[i]);
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
