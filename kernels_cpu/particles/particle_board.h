// SPDX-License-Identifier: Apache-2.0
// Particles as billboards: sorted by the host, blended front to back, one colour each; blurred by
// their motion and by a lens.
// in: boards, their order in a block of pixels -> out: planes of pixels.
// Monette and Whitehead 2014, 3.5; docs/particles.md, "Billboards".
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/blend_layer.h"
#include "kernels_cpu/particles/particle_board_params.h"
#include "kernels_cpu/particles/particle_light.h"
#include "kernels_cpu/particles/particle_march.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Integral of (1 - x^2)^(5/2) from 0 to y, |y| <= 1; error below 6e-7.
template <class T>
PILEUS_FN T chord_power_integral(T y) {
    const T s = y * y;
    T p = all<T>(-7.40553856e-3f);
    p = p * s + 1.66274012e-2f;
    p = p * s - 2.24886319e-2f;
    p = p * s - 3.54874696e-2f;
    p = p * s + 3.727256e-1f;
    p = p * s - 8.33089481e-1f;
    p = p * s + 9.99992507e-1f;
    return y * p;
}

/// v^power for v in [0, 1].
template <class T>
PILEUS_FN T falloff_(T v, float power) {
    return select(v > 1e-30f, exp_(power * log_(max_(v, all<T>(1e-30f)))), T{});
}

/// Share of a ball's depth that lies before `s` radii behind its middle, on the ray through it.
template <class T>
PILEUS_FN T share_before(T s) {
    const T x = max_(min_(s, all<T>(1.0f)), all<T>(-1.0f)), square = x * x;
    return 0.5f + x * ((15.0f / 16) - square * ((5.0f / 8) - square * (3.0f / 16)));
}

/// W pixels' rays before the camera, and what they have seen.
template <class T>
struct BoardPixels {
    T ox, oy, dx, dy;          ///< from (ox, oy, 0) along (dx, dy, 1)
    T per_length, per_square;  ///< of that direction
    T transmittance, half, depth, colour[3], opaque;
};

/// Mean over the shutter's time of the integral that a moving board has at distance^2 `square`
/// (in shown radii) of the ray's closest approach; places begin and end, in radii, from there.
template <bool Curved, class T>
PILEUS_FN T moving_depth(const ParticleBoard& o, T inner, T begin, T end) {
    const T half = sqrt_(max_(inner, all<T>(1e-20f)));
    const T length = end - begin;
    if constexpr (!Curved) {
        const T per_half = 1.0f / half;
        const T from = max_(min_(begin * per_half, all<T>(1.0f)), all<T>(-1.0f));
        const T to = max_(min_(end * per_half, all<T>(1.0f)), all<T>(-1.0f));
        const T part = max_(chord_power_integral(to) - chord_power_integral(from), T{});
        return inner * inner * inner * part / length;
    } else {
        // Gauss and Legendre, five places.
        constexpr float kAt[5] = {-0.906179846f, -0.538469310f, 0.0f, 0.538469310f, 0.906179846f};
        constexpr float kWeight[5] = {0.118463443f, 0.239314335f, 0.284444444f, 0.239314335f,
                                      0.118463443f};
        const T from = min_(max_(begin, T{} - half), half), to = max_(min_(end, half), T{} - half);
        const T middle = 0.5f * (from + to), reach = 0.5f * (to - from);
        T sum{};
        for (int i = 0; i < 5; ++i) {
            const T x = middle + kAt[i] * reach;
            sum = sum + kWeight[i] * falloff_(max_(inner - x * x, T{}), o.power);
        }
        return sum * max_(to - from, T{}) / length;
    }
}

/// Optical depth of a board along W rays, before anything cuts it.
template <bool Moving, bool Curved, class T>
PILEUS_FN T board_depth(const ParticleBoard& o, const BoardPixels<T>& v, const Vec<T>& p) {
    // Distances from the ray by cross products: no difference of squares.
    const Vec<T> c{p.y - p.z * v.dy, p.z * v.dx - p.x, p.x * v.dy - p.y * v.dx};
    const T scale = v.per_square * o.per_square;
    const T inner = 1.0f - dot(c, c) * scale;
    if (!Moving && !any(inner > 0.0f)) return T{};
    const auto at_rest = [&](T own) {
        const T u = max_(own, T{});
        if constexpr (Curved)
            return falloff_(u, o.power);
        else
            return u * u * sqrt_(u);
    };
    if constexpr (!Moving) {
        return at_rest(inner);
    } else {
        const Vec<T> w{o.way[1] - o.way[2] * v.dy, o.way[2] * v.dx - o.way[0],
                       o.way[0] * v.dy - o.way[1] * v.dx};
        const T square = dot(w, w);
        // Shorter ways than a hundredth of a radius are none.
        const auto moves = square * scale > 1e-4f;
        if (!any(moves)) return at_rest(inner);
        const T closest = T{} - dot(c, w) / max_(square, all<T>(1e-30f));
        const Vec<T> n{c.x + closest * w.x, c.y + closest * w.y, c.z + closest * w.z};
        const T root = sqrt_(max_(square * scale, all<T>(1e-4f)));
        const T mean = moving_depth<Curved>(o, max_(1.0f - dot(n, n) * scale, T{}),
                                            (-0.5f - closest) * root, (0.5f - closest) * root);
        return select(moves, mean, at_rest(inner));
    }
}

template <bool Moving, bool Curved, class T>
PILEUS_FN void blend_board(const ParticleBoardBuffers& b, const ParticleBoard& o, float cut,
                           BoardPixels<T>& v) {
    const Vec<T> p{o.at[0] - v.ox, o.at[1] - v.oy, all<T>(o.at[2])};
    T tau = o.whole * board_depth<Moving, Curved>(o, v, p);
    if (!any(tau > 0.0f)) return;
    const bool near = o.at[2] * o.per_radius < 2;
    const T along = (p.x * v.dx + p.y * v.dy + p.z) * v.per_length;
    if (b.opaque_depth != nullptr) tau = tau * share_before((v.opaque - along) * o.per_radius);
    if (near) tau = tau * share_before(along * o.per_radius);
    v.depth = v.depth + tau;
    const Attenuated<T> a = attenuate(v.transmittance, select(v.transmittance >= cut, tau, T{}));
    if (b.half_depth != nullptr)
        v.half = select((v.transmittance > 0.5f) & (a.after <= 0.5f), max_(along, T{}), v.half);
    v.transmittance = a.after;
    for (int c = 0; c < 3; ++c) v.colour[c] = v.colour[c] + a.taken * o.colour[c];
}

/// Boards between two looks at whether anything is seen behind them.
constexpr std::int32_t kBoardsBetween = 8;

/// W pixels, a block from column x and row y on, within a rectangle.
template <int W, bool Moving, bool Curved>
PILEUS_FN void board_pixels(const ParticleBoardParams& k, const ParticleBoardBuffers& b,
                            const ParticleTile& tile, std::int32_t x, std::int32_t y) {
    using T = F<W>;
    const CameraParams& c = k.camera;
    const I<W> number = iota<I<W>>();
    const T column = to_float(number % kMarchAcross<W> + x),
            row = to_float(number / kMarchAcross<W> + y);
    const std::int64_t pixels = std::int64_t(c.width) * c.height;
    const PlanePlace<T> place = plane_place(c, picture_x(c, column), picture_y(c, row));
    const T sx = place.x, sy = place.y;
    const bool parallel = c.orthographic != 0;
    BoardPixels<T> v{};
    v.ox = parallel ? sx : T{}, v.oy = parallel ? sy : T{};
    v.dx = parallel ? T{} : sx, v.dy = parallel ? T{} : sy;
    v.per_square = 1.0f / (v.dx * v.dx + v.dy * v.dy + 1.0f);
    v.per_length = sqrt_(v.per_square);
    v.opaque = v.half = all<T>(__builtin_inff());
    // Lanes beyond the picture see nothing.
    for_block<W>(c, x, y, tile.y_end, [&](int l, std::int64_t pixel) {
        set_lane(v.transmittance, l, b.transmittance[pixel]);
        for (int i = 0; i < 3; ++i) set_lane(v.colour[i], l, b.colour[i * pixels + pixel]);
        if (b.opaque_depth != nullptr) set_lane(v.opaque, l, b.opaque_depth[pixel]);
        if (b.half_depth != nullptr) set_lane(v.half, l, b.half_depth[pixel]);
        if (b.optical_depth != nullptr) set_lane(v.depth, l, b.optical_depth[pixel]);
    });
    const bool to_the_end = b.optical_depth != nullptr;
    const std::int32_t last_x = x + kMarchAcross<W> - 1, last_y = y + W / kMarchAcross<W> - 1;
    for (std::int32_t j = 0; j < tile.count; ++j) {
        if (j % kBoardsBetween == 0 && !to_the_end && !any(v.transmittance >= k.cut)) break;
        const ParticleBoard& o = k.boards[tile.seen[j].ball];
        // Beside these few pixels.
        const bool beside =
            (o.low[0] > last_x) | (o.high[0] < x) | (o.low[1] > last_y) | (o.high[1] < y);
        if (!beside) blend_board<Moving, Curved>(b, o, k.cut, v);
    }
    for_block<W>(c, x, y, tile.y_end, [&](int l, std::int64_t pixel) {
        b.transmittance[pixel] = lane(v.transmittance, l);
        for (int i = 0; i < 3; ++i) b.colour[i * pixels + pixel] = lane(v.colour[i], l);
        if (b.half_depth != nullptr) b.half_depth[pixel] = lane(v.half, l);
        if (b.optical_depth != nullptr) b.optical_depth[pixel] = lane(v.depth, l);
    });
}

template <int W>
PILEUS_FN void board_tile(const ParticleBoardParams& k, const ParticleBoardBuffers& b,
                          const ParticleTile& tile) {
    constexpr int across = kMarchAcross<W>;
    for (std::int32_t y = tile.y_begin; y < tile.y_end; y += W / across)
        for (std::int32_t x = tile.x_begin; x < tile.x_end; x += across)
            if (k.moving == 0 && k.curved == 0)
                board_pixels<W, false, false>(k, b, tile, x, y);
            else if (k.curved == 0)
                board_pixels<W, true, false>(k, b, tile, x, y);
            else
                board_pixels<W, true, true>(k, b, tile, x, y);
}

/// Tiles [begin, end) of b.tiles.
template <int W>
PILEUS_FN void board_tiles(const ParticleBoardParams& k, const ParticleBoardTileBuffers& b,
                           std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) board_tile<W>(k, b.board, b.tiles[i]);
}

/// Colours of the boards [begin, end), W balls side by side: the light that each sends towards the
/// camera, as a mean over its extinction.
template <int W>
PILEUS_FN void board_colours(const ParticleMarchParams& k, const ParticleColourBuffers& b,
                             std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const CameraParams& c = k.camera;
    for (std::uint32_t first = begin; first < end; first += W) {
        Vec<T> to{};
        T depth{}, reach{}, seen{}, sky[3] = {};
        for (int l = 0; l < W; ++l) {
            const std::uint32_t i =
                first + std::uint32_t(l) < end ? first + std::uint32_t(l) : first;
            const ParticleBoard& o = b.boards[i];
            const bool parallel = c.orthographic != 0;
            const float at[3] = {parallel ? 0 : o.at[0], parallel ? 0 : o.at[1],
                                 parallel ? 1 : o.at[2]};
            set_lane(to.x, l, at[0] * c.right[0] + at[1] * c.up[0] + at[2] * c.forward[0]);
            set_lane(to.y, l, at[0] * c.right[1] + at[1] * c.up[1] + at[2] * c.forward[1]);
            set_lane(to.z, l, at[0] * c.right[2] + at[1] * c.up[2] + at[2] * c.forward[2]);
            if (k.orders > 0) {
                const ParticleShade& s = b.shade[i];
                set_lane(depth, l, s.depth);
                set_lane(
                    reach, l,
                    s.slope[0] * s.slope[0] + s.slope[1] * s.slope[1] + s.slope[2] * s.slope[2]);
            }
            set_lane(seen, l, dimmed_by_meshes(b.seen) ? b.seen[i] : 1.0f);
            for (int n = 0; n < 3 && b.sky != nullptr; ++n)
                set_lane(sky[n], l, b.sky[std::uint64_t(n) * b.balls + i]);
        }
        const T square = dot(to, to);
        const T per = 1.0f / sqrt_(max_(square, all<T>(1e-30f)));
        to = {to.x * per, to.y * per, to.z * per};
        const ParticlePhases<T> phases = particle_phases(k, to);
        reach = sqrt_(reach);
        T light[3] = {};
        for (int n = 0; n < 3; ++n) light[n] = k.albedo[n] * sky[n];
        T tint[3], left[3];
        for (int i = 0; i < 3; ++i) tint[i] = left[i] = lanes_of_balls<W>(b.tint, i, first, end);
        for (int n = 0; n < k.orders; ++n) {
            const T arrives = phases.order[n] * seen * mean_light(depth, reach, k.thinner[n]);
            for (int i = 0; i < 3; ++i) {
                light[i] = light[i] + arrives * (left[i] * k.sun[n][i]);
                left[i] = left[i] * tint[i];
            }
        }
        for (int l = 0; l < W; ++l)
            if (first + std::uint32_t(l) < end)
                for (int i = 0; i < 3; ++i)
                    b.boards[first + std::uint32_t(l)].colour[i] = lane(light[i], l);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
