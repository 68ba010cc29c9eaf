// SPDX-License-Identifier: Apache-2.0
// A heap of rising air: the union of balls, bent, with lumps upon it, filled with water that is
// adiabatic in the core and thinned by dry air from the edge.
// in: a grid, balls -> out: densities in [0, 1], the same bits at every width and for any list of
// balls that holds those which count. docs/generators.md; Cotton, Bryan, van den Heever 2011,
// ch. 7.
#pragma once
#include "kernels_cpu/procedural/balls.h"
#include "kernels_cpu/procedural/cloud_anvil.h"
#include "kernels_cpu/procedural/cloud_base.h"

namespace pileus {
inline namespace PILEUS_ISA {

// What varies slowly is worked out at every fourth cell and is trilinear between.
constexpr int kCloudStride = 4;
constexpr int kCloudNodes = 32;  // 3 x 3 x 3 of a block; the last ones stand for nothing
enum CloudNodeField {
    kNodeBendX,
    kNodeBendY,
    kNodeBendZ,
    kNodePlanX,
    kNodePlanY,
    kNodeAct,    ///< how lively the surface is, 0 to 1
    kNodeDry,    ///< share of dry air at the edge
    kNodeTaken,  ///< air taken in on the way up over the mean
    kNodeWave,   ///< lift of the condensation level
    kNodeFields
};

/// Cells of the grid, and the ball around their bent points.
struct CloudPart {
    std::int32_t begin[3], end[3];
    float centre[3];
    float radius;
};

struct CloudNodeSet {
    float value[kNodeFields][kCloudNodes];
    float bent[3][kCloudNodes];  ///< where balls are read
};

/// Bends at two scales, so that no ball stays a ball, and of the balls alone the outline in plan.
template <class T>
PILEUS_FN void bend_node(const CloudParams& k, const Vec<T>& p, Vec<T>& bend, T& plan_x,
                         T& plan_y) {
    bend = {T{}, T{}, T{}};
    float scale = k.bend_per_m, reach = k.bend;
    for (std::uint32_t octave = 0; octave < 2; ++octave) {
        const std::uint32_t s = k.seed + 16u + octave * 3u;
        const T x = p.x * scale, y = p.y * scale, z = p.z * scale;
        bend.x = bend.x + reach * gradient_noise<T>(x, y, z, s);
        bend.y = bend.y + reach * gradient_noise<T>(x, y, z, s + 1u);
        bend.z = bend.z + reach * gradient_noise<T>(x, y, z, s + 2u);
        scale *= 2.0f, reach *= 0.45f;
    }
    plan_x = T{}, plan_y = T{};
    scale = k.plan_per_m, reach = k.plan;
    for (std::uint32_t octave = 0; octave < 2; ++octave) {
        const std::uint32_t s = k.seed + 32u + octave * 2u;
        const T x = p.x * scale, y = p.y * scale, z = p.z * (scale * 0.4f);
        plan_x = plan_x + reach * gradient_noise<T>(x, y, z, s);
        plan_y = plan_y + reach * gradient_noise<T>(x, y, z, s + 1u);
        scale *= 2.0f, reach *= 0.45f;
    }
}

/// Mean vigour of the balls about as near as the nearest. Two passes: weights by a running
/// distance would depend on far balls.
template <class T>
PILEUS_FN T vigour_at(const CloudParams& k, const Vec<T>& q, const std::int32_t* near,
                      std::int32_t count) {
    const T least = nearest_ball(q, k.balls, near, count);
    T sum{}, weights{};
    const float per_reach = 1.0f / k.vigour_reach;
    for (std::int32_t i = 0; i < count; ++i) {
        const CloudBall& b = k.balls[near[i]];
        const T w = max_(1.0f - (ball_distance(q, b) - least) * per_reach, T{});
        sum = sum + w * w * b.vigour, weights = weights + w * w;
    }
    return sum / max_(weights, all<T>(1e-6f));
}

/// Keeps the balls that count somewhere in the part, in their order: of `count` of `from`, or of
/// all where that is null, with those `wide` farther off than could be nearest. Returns how many;
/// 0: all the part is clear air. `kept` may be `from`.
template <int W>
PILEUS_FN std::int32_t cull_balls(const CloudParams& k, const CloudPart& part, float reach,
                                  float wide, const std::int32_t* from, std::int32_t count,
                                  std::int32_t* kept) {
    const auto gaps = [&](std::int32_t i, I<W>& which) {
        const M<W> real = iota<I<W>>() + i < count;
        which = iota<I<W>>() + i;
        if (from != nullptr) __builtin_memcpy(&which, from + i, sizeof which);
        which = select(real, which, I<W>{});
        const float* balls = &k.balls[0].x;
        const I<W> at = which * kCloudBallFloats;
        const F<W> x = gather(balls, at) - part.centre[0],
                   y = gather(balls + 1, at) - part.centre[1],
                   z = gather(balls + 2, at) - part.centre[2];
        return select(real, F<W>(sqrt_(x * x + y * y + z * z) - gather(balls + 3, at)),
                      all<F<W>>(1e9f));
    };
    I<W> which;
    F<W> least = all<F<W>>(1e9f);
    for (std::int32_t i = 0; i < count; i += W) least = min_(least, gaps(i, which));
    float nearest = lane(least, 0);
    for (int l = 1; l < W; ++l) nearest = min_(nearest, float(lane(least, l)));
    if (nearest > part.radius + reach && !near_anvil(k, part.centre, part.radius, reach)) return 0;
    // Blending lowers distances by the largest width at most, whatever the number of balls.
    float most = nearest + 2.0f * (part.radius + k.join) + wide;
    if (k.all_balls != 0) most = 1e8f;
    std::int32_t n = 0;
    for (std::int32_t i = 0; i < count; i += W) {
        const F<W> gap = gaps(i, which);
        std::uint32_t near = bits_of(gap <= most);
        for (; near != 0; near &= near - 1) kept[n++] = lane(which, lowest_bit(near));
    }
    return n;
}

/// The ball around bent nodes, a little wider than rounding needs.
PILEUS_FN void enclose_nodes(const CloudParams& k, const CloudNodeSet& nodes, const int* which,
                             int count, CloudPart& part) {
    float square = 0.0f;
    for (int a = 0; a < 3; ++a) {
        float from = nodes.bent[a][which[0]], to = from;
        for (int i = 1; i < count; ++i) {
            from = min_(from, nodes.bent[a][which[i]]);
            to = max_(to, nodes.bent[a][which[i]]);
        }
        part.centre[a] = 0.5f * (from + to);
        square += 0.25f * (to - from) * (to - from);
    }
    part.radius = sqrt_(square) + 1e-4f * k.height;
}

/// Lanes of a block's nodes, from number `first` on.
template <int W>
PILEUS_FN Vec<F<W>> node_places(const CloudParams& k, const CloudPart& block, int first) {
    float place[3][W];
    for (int l = 0; l < W; ++l) {
        const int i = min_(first + l, 26), at[3] = {i % 3, i / 3 % 3, i / 9};
        for (int a = 0; a < 3; ++a)
            place[a][l] = k.corner[a] + float(block.begin[a] + at[a] * kCloudStride) * k.cell[a];
    }
    Vec<F<W>> p;
    __builtin_memcpy(&p.x, place[0], sizeof p.x);
    __builtin_memcpy(&p.y, place[1], sizeof p.y);
    __builtin_memcpy(&p.z, place[2], sizeof p.z);
    return p;
}

/// Places and bends of a block's nodes.
template <int W>
PILEUS_FN void bend_nodes(const CloudParams& k, const CloudPart& block, CloudNodeSet& nodes) {
    using T = F<W>;
    for (int g = 0; g < kCloudNodes; g += W) {
        const Vec<T> p = node_places<W>(k, block, g);
        Vec<T> bend;
        T plan_x, plan_y;
        bend_node(k, p, bend, plan_x, plan_y);
        const T bent[3] = {p.x + bend.x + plan_x, p.y + bend.y + plan_y, p.z + bend.z};
        const T fields[5] = {bend.x, bend.y, bend.z, plan_x, plan_y};
        for (int f = 0; f < 5; ++f) __builtin_memcpy(&nodes.value[f][g], &fields[f], sizeof(T));
        for (int a = 0; a < 3; ++a) __builtin_memcpy(&nodes.bent[a][g], &bent[a], sizeof(T));
    }
}

/// How lively the surface is, how dry its edge, how high the condensation level, at a block's
/// nodes.
template <int W>
PILEUS_FN void liven_nodes(const CloudParams& k, const CloudPart& block, const std::int32_t* near,
                           std::int32_t count, CloudNodeSet& nodes) {
    using T = F<W>;
    const float per_height = 1.0f / k.height;
    const T one = all<T>(1.0f);
    for (int g = 0; g < kCloudNodes; g += W) {
        Vec<T> q;
        __builtin_memcpy(&q.x, &nodes.bent[0][g], sizeof(T));
        __builtin_memcpy(&q.y, &nodes.bent[1][g], sizeof(T));
        __builtin_memcpy(&q.z, &nodes.bent[2][g], sizeof(T));
        const Vec<T> p = node_places<W>(k, block, g);
        const float wide = per_height * (1 / 0.3f);
        const T slow = gradient_noise<T>(p.x * wide, p.y * wide, p.z * wide, k.seed + 40u);
        const T vigour = vigour_at(k, q, near, count);
        const T fresh = smooth_ramp<T>(vigour * (1.0f - 0.7f * min_(k.age, 1.0f)) + slow * 0.6f);
        // Calm at the base and on old turrets.
        const T act = (0.45f + 0.55f * smooth_ramp<T>(p.z * (per_height * (1 / 0.18f)))) *
                      (0.72f + 0.28f * fresh);
        const T dry =
            max_(min_((k.dilution + 0.4f * k.age) * (1.5f - act + slow * 0.6f), one), T{});
        // Fresh turrets take in less air than old ones; eddies mix it unevenly.
        const float eddy = per_height * (1 / 0.15f);
        const T mixed = gradient_noise<T>(p.x * eddy, p.y * eddy, p.z * eddy, k.seed + 43u);
        const T taken = max_(1.35f - 0.7f * fresh + 0.8f * mixed, all<T>(0.2f));
        const float coarse = per_height * (1 / 0.22f), fine = per_height * (1 / 0.08f);
        const T wave =
            (0.012f * k.height) *
            (gradient_noise<T>(p.x * coarse, p.y * coarse, p.z * (coarse * 0.3f), k.seed + 41u) +
             gradient_noise<T>(p.x * fine, p.y * fine, p.z * (fine * 0.3f), k.seed + 42u));
        __builtin_memcpy(&nodes.value[kNodeAct][g], &act, sizeof act);
        __builtin_memcpy(&nodes.value[kNodeDry][g], &dry, sizeof dry);
        __builtin_memcpy(&nodes.value[kNodeTaken][g], &taken, sizeof taken);
        __builtin_memcpy(&nodes.value[kNodeWave][g], &wave, sizeof wave);
    }
}

/// A field between the eight nodes of a part: a polynomial of the share along each axis.
struct CloudNodeCubic {
    float c[8];
};
PILEUS_FN CloudNodeCubic between_nodes(const float* v, const int* n) {
    const float x = v[n[1]] - v[n[0]], y = v[n[2]] - v[n[0]], z = v[n[4]] - v[n[0]];
    const float xy = v[n[3]] - v[n[2]] - x, xz = v[n[5]] - v[n[4]] - x, yz = v[n[6]] - v[n[4]] - y;
    const float xyz = v[n[7]] - v[n[6]] - v[n[5]] + v[n[4]] - xy;
    return {{v[n[0]], x, y, xy, z, xz, yz, xyz}};
}
template <class T>
PILEUS_FN T at_share(const CloudNodeCubic& n, T x, T y, T z) {
    return (n.c[0] + n.c[1] * x) + y * (n.c[2] + n.c[3] * x) +
           z * ((n.c[4] + n.c[5] * x) + y * (n.c[6] + n.c[7] * x));
}

/// Distance to the union of balls, blended, and the normal of the nearest.
template <class T>
PILEUS_FN void heap_surface(const CloudParams& k, const Vec<T>& q, const std::int32_t* near,
                            std::int32_t count, CloudSurface<T>& s) {
    T d = all<T>(1e9f), least = d, length = all<T>(1.0f);
    Vec<T> to{T{}, T{}, length};
    for (std::int32_t i = 0; i < count; ++i) {
        const CloudBall& b = k.balls[near[i]];
        const T x = q.x - b.x, y = q.y - b.y, z = q.z - b.z;
        const T far = sqrt_(x * x + y * y + z * z);
        const T e = far - b.r;
        const auto nearer = e < least;
        least = select(nearer, e, least), length = select(nearer, far, length);
        to = {select(nearer, x, to.x), select(nearer, y, to.y), select(nearer, z, to.z)};
        d = blend_min(d, e, all<T>(b.join), all<T>(b.unjoin));
    }
    const T inverse = 1.0f / max_(length, all<T>(1e-6f));
    s.distance = d;
    s.normal = {to.x * inverse, to.y * inverse, to.z * inverse};
}

/// x^(21/32), near the 2/3 by which extinction grows with water: x >= 0.
template <class T>
PILEUS_FN T two_thirds_power(T x) {
    const T half = sqrt_(x), eighth = sqrt_(sqrt_(half));
    return half * eighth * sqrt_(sqrt_(eighth));
}

/// Height in metres by which saturated air must rise for the water that as much outside air
/// evaporates: 0.66 g/m^3, of air of 85 % relative humidity at 15 degrees Celsius.
constexpr float kDeficitRise = 300.0f;
/// Height over which deficits grow from none at the condensation level, where all air is moist.
constexpr float kDeficitFoot = 80.0f;
/// Air taken in over the mean, at the edge and in the core.
constexpr float kTakenEdge = 1.2f, kTakenCore = 0.5f;

/// Water over adiabatic water of a parcel that has risen by z and has taken in the share
/// `taken` = (1/m) z of outside air on its way: of dq/dz = rise - taken/z (q + deficit).
/// (1 - e^-x)/x is 1/(1 + x/2 + x^2/12) to the second order.
template <class T>
PILEUS_FN T entraining_plume(T z, T rate) {
    const T x = rate * z;
    const T deficit = rate * (kDeficitRise * z / (z + kDeficitFoot));
    return max_(1.0f - deficit, T{}) / (1.0f + x * (0.5f + x * (1.0f / 12.0f)));
}

/// Extinction over that of the full height, of points whose surface is known. `core`: distance to
/// the surface before any lumps.
template <class T>
PILEUS_FN T heap_density(const CloudParams& k, T level, T core, T d, T act, T dry, T taken) {
    const T zc = max_(level, T{});
    const T width = k.soft + (k.crisp - k.soft) * smooth_ramp<T>(1.3f * act - 0.2f);
    // Dry air needs height to come in, and reaches the core less.
    const T inward = smooth_ramp<T>(core * (-1.0f / (0.22f * k.height)));
    const T dilution = zc / (zc + 150.0f) * dry * (1.0f - inward);
    const T rate = k.entrainment * taken * (kTakenEdge - (kTakenEdge - kTakenCore) * inward);
    const T plume = entraining_plume<T>(zc, rate);
    const T chi = (1.0f - dilution) * plume * smooth_ramp<T>(0.5f - d / width);
    // The mixing line: what dry air takes evaporates, before the mixture is halved.
    const T left = chi - (1.0f - chi) * 0.07f * zc / (zc + 60.0f);
    const T rise = zc / (1.0f + zc * k.saturation);
    const T water = two_thirds_power<T>(min_(rise * k.per_full, all<T>(1.0f)));
    return max_(left, T{}) * (1.0f - 0.5f * min_(k.age, 1.0f)) * water;
}

/// Fills four cells along each axis; `nodes` are the block's, `n` the part's eight corners of them.
template <int W>
PILEUS_FN void fill_heap_part(const CloudParams& k, const CloudPart& part,
                              const CloudNodeSet& nodes, const int* n, const std::int32_t* near,
                              std::int32_t count, float* density) {
    using T = F<W>;
    CloudNodeCubic field[kNodeFields];
    for (int f = 0; f < kNodeFields; ++f) field[f] = between_nodes(nodes.value[f], n);
    const bool iced = k.anvil_radius > 0.0f;
    const float width = 0.5f * (iced ? max_(k.soft, kAnvilEdge * k.height) : k.soft);
    const float hangs = -kShelfMost * k.shelf;
    for (int g = 0; g < 64; g += W) {
        const I<W> i = iota<I<W>>() + g;
        const T ix = to_float(i & 3), iy = to_float((i >> 2) & 3), iz = to_float(i >> 4);
        const T x = ix * 0.25f, y = iy * 0.25f, z = iz * 0.25f;
        const Vec<T> p{k.corner[0] + (ix + float(part.begin[0])) * k.cell[0],
                       k.corner[1] + (iy + float(part.begin[1])) * k.cell[1],
                       k.corner[2] + (iz + float(part.begin[2])) * k.cell[2]};
        T level = p.z + at_share(field[kNodeWave], x, y, z);
        if (!any(level > hangs)) continue;
        CloudSurface<T> s;
        s.at = {p.x + at_share(field[kNodeBendX], x, y, z),
                p.y + at_share(field[kNodeBendY], x, y, z),
                p.z + at_share(field[kNodeBendZ], x, y, z)};
        const Vec<T> q{s.at.x + at_share(field[kNodePlanX], x, y, z),
                       s.at.y + at_share(field[kNodePlanY], x, y, z), s.at.z};
        heap_surface(k, q, near, count, s);
        T act = at_share(field[kNodeAct], x, y, z);
        AnvilShare<T> share{};
        if (iced) share = join_anvil(k, s.at, s, act);
        const T core = s.distance;
        if (k.shelf > 0.0f && any(level < kShelfReach * k.shelf))
            level = level + shelf_drop(k, p, level, core);
        s.at.z = s.at.z - k.lift;
        add_octaves(s, k.lump, k.octaves, act, k.erosion, 0.16f * k.age, width, k.seed);
        if (!any(s.distance < width)) continue;
        T value = heap_density(k, level, core, s.distance, act, at_share(field[kNodeDry], x, y, z),
                               at_share(field[kNodeTaken], x, y, z));
        if (iced) value = value + share.ice * (anvil_density(k, s.distance, share) - value);
        value = value * k.water;
        for (int l = 0; l < W; ++l) {
            const int c = g + l;
            const std::int32_t at[3] = {part.begin[0] + (c & 3), part.begin[1] + (c >> 2 & 3),
                                        part.begin[2] + (c >> 4)};
            if (at[0] >= part.end[0] || at[1] >= part.end[1] || at[2] >= part.end[2]) continue;
            float& cell = density[(std::int64_t(at[2]) * k.size[1] + at[1]) * k.size[0] + at[0]];
            cell = max_(cell, float(lane(value, l)));
        }
    }
}

/// One block of 8 cells along each axis, or what of it is there.
template <int W>
PILEUS_FN void fill_heap_block(const CloudParams& k, CloudPart block, std::int32_t* scratch,
                               float* density) {
    constexpr int kAll[27] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                              14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
    CloudNodeSet nodes;
    bend_nodes<W>(k, block, nodes);
    enclose_nodes(k, nodes, kAll, 27, block);
    const float reach = 2.0f * k.lump * kLumpReach + 0.5f * k.soft + k.join;
    std::int32_t *near = scratch, *nearest = scratch + kMaxCloudBalls;
    const std::int32_t held =
        cull_balls<W>(k, block, reach, k.vigour_reach, nullptr, k.count, near);
    if (held == 0) return;
    liven_nodes<W>(k, block, near, held, nodes);
    for (int i = 0; i < 8; ++i) {
        const int at[3] = {i & 1, i >> 1 & 1, i >> 2};
        CloudPart part = block;
        bool empty = false;
        for (int a = 0; a < 3; ++a) {
            part.begin[a] = block.begin[a] + at[a] * kCloudStride;
            part.end[a] = min_(part.begin[a] + kCloudStride, block.end[a]);
            empty = empty || part.begin[a] >= part.end[a];
        }
        if (empty) continue;
        int n[8];
        for (int c = 0; c < 8; ++c)
            n[c] = at[0] + (c & 1) + 3 * (at[1] + (c >> 1 & 1)) + 9 * (at[2] + (c >> 2));
        enclose_nodes(k, nodes, n, 8, part);
        const std::int32_t count = cull_balls<W>(k, part, reach, 0.0f, near, held, nearest);
        if (count > 0) fill_heap_part<W>(k, part, nodes, n, nearest, count, density);
    }
}

/// Fills rows of blocks along x, [begin, end) of those that k.rows_y go into a layer. Of what is
/// there and what is made the larger stays.
template <int W>
PILEUS_FN void fill_cloud(const CloudParams& k, const CloudBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    for (std::uint32_t r = begin; r < end; ++r) {
        CloudPart block{};
        block.begin[1] = k.begin[1] + std::int32_t(r) % k.rows_y * kCloudBlock;
        block.begin[2] = k.begin[2] + std::int32_t(r) / k.rows_y * kCloudBlock;
        for (int a = 1; a < 3; ++a) block.end[a] = min_(block.begin[a] + kCloudBlock, k.end[a]);
        for (std::int32_t x = k.begin[0]; x < k.end[0]; x += kCloudBlock) {
            block.begin[0] = x;
            block.end[0] = min_(x + kCloudBlock, k.end[0]);
            fill_heap_block<W>(k, block, b.scratch, b.density);
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
