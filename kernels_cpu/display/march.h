// SPDX-License-Identifier: Apache-2.0
// Marching: the picture of lit nodes per pixel.
// in: density, majorants, lit node grids -> out: planes of pixels.
// docs/methods.md 3, repair 4, and 4 (closed form per step: S (1 - e^-sigma dt) / sigma).
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/beam.h"
#include "kernels_cpu/display/behind.h"
#include "kernels_cpu/display/lit_nodes.h"
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/display/march_sun.h"
#include "kernels_cpu/display/pixel_light.h"
#include "kernels_cpu/display/ray_harmonics.h"
#include "kernels_cpu/media/phase_table.h"

// A march's step is one function among several alike: the compiler would call some of them.
#if defined(__CUDACC__) || defined(PILEUS_COVERAGE) || \
    (defined(PILEUS_FLIGHT) && defined(__OPTIMIZE_SIZE__))
#define PILEUS_INLINED
#else
#define PILEUS_INLINED __attribute__((always_inline))
#endif

namespace pileus {
inline namespace PILEUS_ISA {

constexpr int kMaxMarched = 3 * 17;  // channels: the picture's and those of sixteen batches

/// Adds light of the sun's beam where its optical depth is `tau`.
template <class T>
PILEUS_FN void add_beam(const MarchParams& k, const MarchBuffers& b, const SunAlongRay<T>& s, T tau,
                        T visible, T (&source)[3]) {
    T light[3];
    beam_light(b.beam, k.beam_sets, k.beam_rest, s.angle, s.most, tau, visible, light);
    for (int c = 0; c < 3; ++c) source[c] = source[c] + light[c] * k.sun_source[0][c];
}

/// The same where the sunlight is `light`: by the share of each medium in the `density` there.
template <bool Constant, class T>
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
        [&](const float* grid) { return read_density<Constant>(grid, at); },
        [&](int i, T share) {
            const T direct = share * s.phase[i] * light;
            for (int c = 0; c < 3; ++c) source[c] = source[c] + direct * k.sun_source[i][c];
        });
}

/// Numbers of the quads at a place.
template <class T>
PILEUS_FN void read_quads(const MarchParams& k, const MarchBuffers& b, const Vec<T>& metres,
                          M_of<T> wanted, T (&out)[4]) {
    const Corners<T> c =
        node_corners(node_position(k.source, metres), k.source.size, k.medium.periodic != 0);
    interpolate_quads(b.quads, c, bits_of(wanted), out);
}

/// What nodes around the camera send along the rays, and their share of what is seen `t` metres
/// from it: all up to half their reach, nothing at its end.
template <int W>
struct NearLight {
    F<W> share{};
    F<W> next{};               ///< m along the ray, where it is looked up again
    F<W> colour[kMaxMarched];  ///< of the last look, 0 before the first
};
template <int W>
PILEUS_FN void read_near(const MarchParams& k, const MarchBuffers& b, const Ray<F<W>>& ray, F<W> t,
                         M<W> wanted, RayHarmonics<W>& h, NearLight<W>& out) {
    using T = F<W>;
    out.share =
        select(wanted, max_(min_(2.0f - t * (2.0f / k.near.reach), all<T>(1.0f)), T{}), T{});
    // Between nodes light varies little: one look, half way to the next, stands for several steps.
    const M<W> due = (out.share > 0.0f) & (t >= out.next);
    if (!any(due)) return;
    const Vec<T> place = along(ray, t + 0.5f * k.near.every);
    turn_to_place(k, ray.direction, place, due, h);
    Vec<T> node = node_position(k.source, place);
    out.next = select(due, t + k.near.every, out.next);
    node.x = node.x - float(k.near.first[0]);
    node.y = node.y - float(k.near.first[1]);
    node.z = node.z - float(k.near.first[2]);
    const Corners<T> c = node_corners(node, k.near.size, false);
    const std::int64_t numbers =
        std::int64_t(k.near.size[0]) * k.near.size[1] * k.near.size[2] * k.sets * k.harmonics;
    for (std::uint32_t lanes = bits_of(due); lanes != 0; lanes &= lanes - 1) {
        const int l = lowest_bit(lanes);
        for (int part = 0; part < k.channels / 3; ++part) {
            float light[3] = {};
            light_along(k, b.near + part * numbers, c, l, h.y[l], light);
            for (int i = 0; i < 3; ++i) {
                float sum = 0;
                for (int s = 0; s < k.sets; ++s) sum = sum + light[s] * k.set_colour[s][i];
                // Bands ring; there is no less than no light.
                if (part == 0 && sum < k.least[i]) sum = k.least[i];
                set_lane(out.colour[3 * part + i], l, sum);
            }
        }
    }
}

/// Adds `weight` times all light that leaves towards the camera: `even`, what is the same for all
/// batches, and that of the nodes, which `quad` holds where there are quads.
template <int W>
PILEUS_FN void add_source(const MarchParams& k, const MarchBuffers& b, const Vec<F<W>>& metres,
                          const Vec<F<W>>& way, RayHarmonics<W>& h, const NearLight<W>& near,
                          const F<W> (&even)[3], const F<W> (&quad)[4], const F<W> (&weight)[3],
                          F<W>* colour) {
    using T = F<W>;
    const bool blends = b.near != nullptr && any(near.share > 0.0f);
    const auto blended = [&](T own, int i) {
        return blends ? own + near.share * (near.colour[i] - own) : own;
    };
    if (b.quads != nullptr) {
        for (int i = 0; i < 3; ++i)
            colour[i] = colour[i] + weight[i] * (blended(quad[i], i) + even[i]);
        return;
    }
    const Corners<T> c =
        node_corners(node_position(k.source, metres), k.source.size, k.medium.periodic != 0);
    const std::int64_t nodes = std::int64_t(k.source.size[0]) * k.source.size[1] * k.source.size[2];
    if (k.bands == 0 || b.near != nullptr) {
        for (int i = 0; i < k.channels; ++i) {
            T source = blended(interpolate(b.source + i * nodes, c), i);
            source = source + even[i % 3];
            colour[i] = colour[i] + weight[i % 3] * source;
        }
        return;
    }
    T source[3];
    for (int i = 0; i < 3; ++i) source[i] = even[i];
    turn_to_place(k, way, metres, weight[0] > 0.0f, h);
    for (std::uint32_t lanes = bits_of(weight[0] > 0.0f); lanes != 0; lanes &= lanes - 1) {
        const int l = lowest_bit(lanes);
        float light[3] = {};
        light_along(k, b.source, c, l, h.y[l], light);
        for (int s = 0; s < k.sets; ++s)
            for (int i = 0; i < 3; ++i)
                set_lane(source[i], l, lane(source[i], l) + light[s] * k.set_colour[s][i]);
    }
    for (int i = 0; i < 3; ++i) colour[i] = colour[i] + weight[i] * source[i];
}

/// Adds light of what lies behind that turned within the peak alone. A ray that ends at a surface
/// has that surface's.
template <int W>
PILEUS_FN void add_behind(const MarchParams& k, const MarchBuffers& b, const Vec<F<W>>& way,
                          std::int32_t x, std::int32_t y, std::int32_t end,
                          const ApartRay<F<W>>& apart, F<W> transmittance, F<W>* colour) {
    using T = F<W>;
    T light[3];
    light_behind(k.behind, way, light);
    if (b.surfaces != nullptr) {
        const std::int64_t plane = std::int64_t(k.camera.width) * k.camera.height;
        for_block<W>(k.lattice, x, y, end, [&](int l, std::int64_t pixel) {
            if (!(b.opaque_depth[pixel] < __builtin_inff())) return;
            const std::int64_t column = pixel % k.lattice.width, row = pixel / k.lattice.width;
            const std::int64_t at = (row * k.lattice.every + k.lattice.first[1]) * k.camera.width +
                                    (column * k.lattice.every + k.lattice.first[0]);
            const float rgb[3] = {b.surfaces[at], b.surfaces[plane + at],
                                  b.surfaces[2 * plane + at]};
            if (k.behind.hidden != 0 && !(rgb[0] + rgb[1] + rgb[2] > 0.0f)) return;
            for (int c = 0; c < 3; ++c) set_lane(light[c], l, rgb[c]);
        });
    }
    for (int i = 0; i < k.channels; ++i)
        colour[i] = colour[i] + max_(apart.left[i % 3] - transmittance, T{}) * light[i % 3];
}

/// Pieces that a step is taken in where it is deep: light falls off within one, and its middle does
/// not stand for it (2 % of sunlight from a face lit as it is seen, in pieces of a quarter). Steps
/// behind a thick medium, taken several at once, are none.
template <class T>
PILEUS_FN T pieces_of(T optical, T stride) {
    constexpr float kDeepStep = 0.4f, kPieces = 4.0f, kMaxPieces = 32.0f;
    const T wanted = min_(max_(optical * kPieces + 1.0f, all<T>(1.0f)), all<T>(kMaxPieces));
    return select((optical > kDeepStep) & (stride <= 1.0f), to_float(to_int(wanted)), all<T>(1.0f));
}

/// W pixels, a block from column x and row y on, in rows before `end`.
template <int W, bool Veiled, bool Constant, bool Detail>
PILEUS_FN void march_pixels(const MarchParams& k, const MarchBuffers& b, std::int32_t x,
                            std::int32_t y, std::int32_t end) {
    using T = F<W>;
    const I<W> number = iota<I<W>>();
    const I<W> column = number % kMarchAcross<W> + x, row = number / kMarchAcross<W> + y;
    const M<W> real = (column < k.lattice.width) & (row < end);
    const std::int64_t pixels = std::int64_t(k.lattice.width) * k.lattice.height;

    const Ray<T> ray = camera_ray(k.camera, to_float(column * k.lattice.every + k.lattice.first[0]),
                                  to_float(row * k.lattice.every + k.lattice.first[1]));
    const Segment<T> box = clip_to_medium(k.medium, ray);
    T leave = box.leave;
    if (b.opaque_depth != nullptr) {
        T opaque{};
        for_block<W>(k.lattice, x, y, end, [&](int l, std::int64_t pixel) {
            set_lane(opaque, l, b.opaque_depth[pixel]);
        });
        leave = min_(leave, opaque);
    }
    leave = select(real, leave, box.enter);

    const SunAlongRay<T> sun = sun_along(k, ray.direction);
    RayHarmonics<W> harmonics;
    NearLight<W> around;
    for (int i = 0; b.near != nullptr && i < k.channels; ++i) around.colour[i] = T{};
    if (k.bands > 0) set_harmonics(k, ray.direction, harmonics);
    const bool wraps = k.medium.periodic != 0;

    T transmittance = all<T>(1.0f), half = all<T>(__builtin_inff()), depth{};
    T colour[kMaxMarched];
    for (int c = 0; c < k.channels; ++c) colour[c] = T{};
    ApartRay<T> apart;
    Pace<T> pace;
    march_ray<Constant>(
        k.medium, ray, box.enter, leave, pace,
        [&](M<W> dense, T middle, T whole, const Vec<T>& centre,
            const Vec<T>& place) PILEUS_INLINED {
            if (!any(dense)) return left_of(k, transmittance, apart) < k.cut;
            T t = middle, width = whole;
            Vec<T> p = centre, metres = place;
            Corners<T> at;
            T density;
            const auto look = [&]() PILEUS_INLINED {
                at = density_corners<Constant>(k.medium, p);
                density = density_at<Constant>(k.medium, at);
                if constexpr (Detail) density = with_detail(*k.medium.detail, metres, density);
            };
            look();
            T optical = select(dense, density * k.medium.sigma * width, T{});
            pace.inside = optical > 0.0f;
            if (!any(pace.inside)) return left_of(k, transmittance, apart) < k.cut;
            const T pieces = pieces_of(optical, pace.stride);
            const auto deep = pieces > 1.0f;
            width = whole / pieces;
            for (T piece{};; piece = piece + 1.0f) {
                if (any(deep)) {
                    t = select(deep, middle + ((piece + 0.5f) * width - 0.5f * whole), middle);
                    metres = reduced(k.medium, along(ray, t));
                    p = in_voxels(k.medium, metres);
                    look();
                    optical =
                        select(dense & (piece < pieces), density * k.medium.sigma * width, T{});
                }
                depth = depth + optical;
                const T alpha = one_minus_exp(optical);
                const T weight = transmittance * alpha;
                T weights[3] = {weight, weight, weight}, direct[3] = {}, kept[3] = {}, quad[4] = {};
                if (k.apart != 0) {
                    apart_step<Constant>(k, b, at, density, optical, apart);
                    for (int c = 0; c < 3; ++c) weights[c] = apart.own[c];
                }
                if (b.quads != nullptr) read_quads(k, b, metres, optical > 0.0f, quad);
                if (sun.lit) {
                    T tau = quad[3], visible = all<T>(1.0f);
                    if (Veiled || k.together == 0) {
                        const Vec<T> node = node_position(k.shadow, metres);
                        const Corners<T> near = node_corners(node, k.shadow.size, wraps);
                        if (k.together == 0) tau = interpolate(b.optical_depth, near);
                        if constexpr (Veiled)
                            visible =
                                max_(min_(interpolate(b.visibility, near), all<T>(1.0f)), T{});
                    }
                    tau = max_(tau, T{});
                    if (k.apart != 0) {
                        add_sun_apart(k, b, sun, apart, tau, visible, direct, kept);
                        for (int i = 0; i < k.channels; ++i)
                            colour[i] = colour[i] + weight * kept[i % 3];
                    } else {
                        T light = exp_(T{} - tau);
                        if constexpr (Veiled) light = light * visible;
                        sun_source_at<Constant>(k, b, sun, at, density, light, direct);
                        if (k.beam_sets > 0) add_beam(k, b, sun, tau, visible, direct);
                    }
                }
                if (b.near != nullptr) read_near(k, b, ray, t, optical > 0.0f, harmonics, around);
                for (int c = 0; c < 3; ++c)
                    direct[c] = direct[c] + (k.apart != 0 ? apart.rest[c] * k.constant[c]
                                                          : all<T>(k.constant[c]));
                add_source<W>(k, b, metres, ray.direction, harmonics, around, direct, quad, weights,
                              colour);
                const T left = transmittance * (1.0f - alpha);
                if (b.half_depth != nullptr) {
                    const auto crosses = (transmittance > 0.5f) & (left <= 0.5f);
                    if (any(crosses)) {
                        const T share = log_(transmittance * 2.0f) / max_(optical, all<T>(1e-30f));
                        half = select(crosses, t + (share - 0.5f) * width, half);
                    }
                }
                transmittance = left;
                if (!any(deep & (piece + 1.0f < pieces))) break;
            }
            const T seen = left_of(k, transmittance, apart);
            for (int i = 0; i < kWiderSteps; ++i)
                pace.stride = select(seen < k.wider[i], all<T>(float(2 << i)), pace.stride);
            return seen < k.cut;
        });
    if (k.apart != 0) add_behind<W>(k, b, ray.direction, x, y, end, apart, transmittance, colour);
    for_block<W>(k.lattice, x, y, end, [&](int l, std::int64_t pixel) {
        b.transmittance[pixel] = lane(transmittance, l);
        if (b.half_depth != nullptr) b.half_depth[pixel] = lane(half, l);
        if (b.ray_depth != nullptr) b.ray_depth[pixel] = lane(depth, l);
        for (int c = 0; c < k.channels; ++c) b.colour[c * pixels + pixel] = lane(colour[c], l);
    });
}

template <int W, bool Constant, bool Detail = false>
PILEUS_FN void march_blocks(const MarchParams& k, const MarchBuffers& b, std::uint32_t begin,
                            std::uint32_t end) {
    constexpr int across = kMarchAcross<W>;
    for (std::uint32_t y = begin; y < end; y += W / across)
        for (std::int32_t x = 0; x < k.lattice.width; x += across)
            if (dimmed_by_meshes(b.visibility))
                march_pixels<W, true, Constant, Detail>(k, b, x, std::int32_t(y),
                                                        std::int32_t(end));
            else
                march_pixels<W, false, Constant, Detail>(k, b, x, std::int32_t(y),
                                                         std::int32_t(end));
}

template <int W>
PILEUS_FN void march_rows(const MarchParams& k, const MarchBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    if (k.medium.constant != 0)
        march_blocks<W, true>(k, b, begin, end);
    else
        march_blocks<W, false>(k, b, begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
