// SPDX-License-Identifier: Apache-2.0
// A procedural cumulus: spheres pushed out by billows, cut flat at the base, in a firm shell.
// in: a grid, spheres -> out: densities in [0, 1], the same bits at every width.
// Rise of liquid water: Rogers and Yau 1989, "A short course in cloud physics", ch. 3.
#pragma once
#include "kernels_cpu/procedural/balls.h"
#include "kernels_cpu/procedural/cumulus_params.h"
#include "kernels_cpu/procedural/noise.h"

namespace pileus {
inline namespace PILEUS_ISA {

constexpr int kCloudPart = 4;       // cells along the edge of a part of a block
constexpr float kCloudCore = 0.1f;  // depth from which on density no longer grows

/// Bends space at two scales, so that no sphere stays a sphere.
template <class T>
PILEUS_FN Vec<T> warp_cloud(const CumulusParams& k, const Vec<T>& p) {
    Vec<T> q = p;
    float scale = 4.5f, reach = kCumulusWarp * 0.45f;
    for (std::uint32_t octave = 0; octave < 2; ++octave) {
        const std::uint32_t s = k.seed + 16u + octave * 3u;
        q.x = q.x + reach * gradient_noise<T>(p.x * scale, p.y * scale, p.z * scale, s);
        q.y = q.y + reach * gradient_noise<T>(p.x * scale, p.y * scale, p.z * scale, s + 1u);
        q.z = q.z + reach * gradient_noise<T>(p.x * scale, p.y * scale, p.z * scale, s + 2u);
        scale *= 2.7f, reach *= 0.45f;
    }
    return q;
}

/// Displacement outwards in [-kCumulusPushIn, kCumulusPushOut]: humps upon humps, as long as cells
/// resolve them.
template <class T>
PILEUS_FN T cloud_billows(const CumulusParams& k, const Vec<T>& p) {
    T sum{};
    float size = 0.080f, reach = 0.030f;
    for (std::uint32_t octave = 0; octave < 4 && size > 1.9f * k.voxel; ++octave) {
        const float scale = 1.0f / size;
        const T hump = billow<T>(p.x * scale, p.y * scale, p.z * scale, k.seed + octave);
        sum = sum + reach * (hump - 0.65f);
        size *= 0.47f, reach *= 0.62f;
    }
    return sum;
}

/// Density at points whose height above the base is p.z, and which are bent to `q`. What whole
/// groups of lanes leave out would give each of them the same number.
template <class T>
PILEUS_FN T cloud_density(const CumulusParams& k, const Vec<T>& p, const Vec<T>& q,
                          const std::int32_t* near, std::int32_t count) {
    const T smooth_d = nearest_ball(q, k.bubbles, near, count);
    if (!any(smooth_d < kCumulusPushOut + k.shell)) return T{};
    // Calm the billows towards the base, where the cloud is young and ragged instead of firm.
    const T calm = 0.55f + 0.45f * smooth_ramp<T>(p.z * 8.0f);
    T d = smooth_d;
    if (any(d > -(kCumulusPushIn + k.shell))) d = d - calm * cloud_billows(k, q);
    // Outside the edge nothing is left that the rest could scale.
    if (!any(d < 0.5f * k.shell)) return T{};
    const T slow = gradient_noise<T>(p.x * 5.0f, p.y * 5.0f, p.z * 5.0f, k.seed + 40u);
    const T fast = gradient_noise<T>(p.x * 14.0f, p.y * 14.0f, p.z * 14.0f, k.seed + 41u);
    // Edge: a thin firm shell, then a core that entrainment has not reached.
    const T edge = smooth_ramp<T>(0.5f - d / k.shell);
    const T core = 0.80f + 0.20f * smooth_ramp<T>(smooth_d * (-1.0f / kCloudCore));
    // Base: a plane that undulates by about one percent and fades in over a few.
    const T ragged = 0.012f * slow + 0.016f * fast;
    const T base = smooth_ramp<T>((p.z + ragged) * (1.0f / 0.035f));
    const T rise = min_(max_(p.z * (1.0f / k.top), all<T>(0.0f)), all<T>(1.0f));
    const T profile = 0.35f + 0.65f * min_(rise * 1.3f, all<T>(1.0f));
    const T patchy = 1.0f - 0.10f * smooth_ramp<T>(0.5f + slow);
    return edge * core * base * profile * patchy;
}

/// Cells of the grid, and the ball around their points.
struct CloudBlock {
    std::int32_t begin[3], end[3];
    float centre[3];
    float radius;
};

PILEUS_FN void place_block(const CumulusParams& k, CloudBlock& b) {
    float sum = 0.0f;
    for (int a = 0; a < 3; ++a) {
        const float half = 0.5f * float(b.end[a] - b.begin[a]) * k.cell[a];
        b.centre[a] = k.corner[a] + (float(b.begin[a]) - 0.5f) * k.cell[a] + half;
        sum += half * half;
    }
    b.radius = sqrt_(sum) + 2.0f * kCumulusWarp;
}

/// From the block's centre to the surfaces of W of `count` spheres, from number `i` of `from` (or
/// of all, where that is null) on; far away for lanes past the end. `which` learns the spheres.
template <int W>
PILEUS_FN F<W> gaps_to_spheres(const CumulusParams& k, const CloudBlock& b,
                               const std::int32_t* from, std::int32_t i, std::int32_t count,
                               I<W>& which) {
    const M<W> real = iota<I<W>>() + i < count;
    which = iota<I<W>>() + i;
    if (from != nullptr) __builtin_memcpy(&which, from + i, sizeof which);
    which = select(real, which, I<W>{});
    const float* spheres = &k.bubbles[0].x;
    const F<W> x = gather(spheres, which * 4) - b.centre[0],
               y = gather(spheres + 1, which * 4) - b.centre[1],
               z = gather(spheres + 2, which * 4) - b.centre[2];
    const F<W> gap = sqrt_(x * x + y * y + z * z) - gather(spheres + 3, which * 4);
    return select(real, gap, all<F<W>>(1e9f));
}

/// Keeps the spheres that can be nearest somewhere in the block; returns how many of `from` (all
/// spheres when null) stay in `kept`, 0 when the block lies clear of the cloud. `kept` may be
/// `from`.
template <int W>
PILEUS_FN std::int32_t cull_spheres(const CumulusParams& k, const CloudBlock& b,
                                    const std::int32_t* from, std::int32_t count,
                                    std::int32_t* kept) {
    I<W> which;
    F<W> least = all<F<W>>(1e9f);
    for (std::int32_t i = 0; i < count; i += W)
        least = min_(least, gaps_to_spheres<W>(k, b, from, i, count, which));
    float nearest = lane(least, 0);
    for (int l = 1; l < W; ++l) nearest = min_(nearest, float(lane(least, l)));
    if (nearest > b.radius + kCumulusPushOut + k.shell) return 0;
    std::int32_t n = 0;
    for (std::int32_t i = 0; i < count; i += W) {
        const F<W> gap = gaps_to_spheres<W>(k, b, from, i, count, which);
        std::uint32_t near = bits_of(gap <= nearest + 2.0f * b.radius);
        for (; near != 0; near &= near - 1) kept[n++] = lane(which, lowest_bit(near));
    }
    return n;
}

/// Ball around the bent points, a little wider than rounding needs.
template <class T>
PILEUS_FN void enclose_points(const Vec<T>* q, int count, CloudBlock& part) {
    Vec<T> low = q[0], high = q[0];
    for (int i = 1; i < count; ++i) {
        low = {min_(low.x, q[i].x), min_(low.y, q[i].y), min_(low.z, q[i].z)};
        high = {max_(high.x, q[i].x), max_(high.y, q[i].y), max_(high.z, q[i].z)};
    }
    const T lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z};
    float square = 0.0f;
    for (int a = 0; a < 3; ++a) {
        float from = lane(lows[a], 0), to = lane(highs[a], 0);
        for (int i = 1; i < width_of<T>; ++i) {
            from = min_(from, float(lane(lows[a], i)));
            to = max_(to, float(lane(highs[a], i)));
        }
        part.centre[a] = 0.5f * (from + to);
        square += 0.25f * (to - from) * (to - from);
    }
    part.radius = sqrt_(square) + 1e-4f;
}

/// Fills a part of a block. Few spheres can be the nearest to its points once these are bent;
/// `scratch` holds a list of kMaxBubbles numbers.
template <int W>
PILEUS_FN void fill_cloud_part(const CumulusParams& k, CloudBlock part, const std::int32_t* near,
                               std::int32_t count, std::int32_t* scratch, float* density) {
    using T = F<W>;
    constexpr int kCells = kCloudPart * kCloudPart * kCloudPart;
    Vec<T> p[kCells / W], q[kCells / W];
    for (int g = 0; g < kCells / W; ++g) {
        // Points beyond the end are not stored; they lie no farther off than others of a block do.
        const I<W> i = iota<I<W>>() + g * W;
        p[g].x = k.corner[0] + to_float((i & 3) + part.begin[0]) * k.cell[0];
        p[g].y = k.corner[1] + to_float(((i >> 2) & 3) + part.begin[1]) * k.cell[1];
        p[g].z = k.corner[2] + to_float((i >> 4) + part.begin[2]) * k.cell[2];
        q[g] = warp_cloud(k, p[g]);
    }
    enclose_points(q, kCells / W, part);
    const std::int32_t n = cull_spheres<W>(k, part, near, count, scratch);
    if (n == 0) return;
    for (int g = 0; g < kCells / W; ++g) {
        const T value = cloud_density(k, p[g], q[g], scratch, n);
        for (int l = 0; l < W; ++l) {
            const int i = g * W + l;
            const std::int32_t x = part.begin[0] + (i & 3), y = part.begin[1] + (i >> 2 & 3),
                               z = part.begin[2] + (i >> 4);
            if (x < part.end[0] && y < part.end[1] && z < part.end[2])
                density[(std::int64_t(z) * k.size[1] + y) * k.size[0] + x] = lane(value, l);
        }
    }
}

template <int W>
PILEUS_FN void fill_cloud_block(const CumulusParams& k, const CloudBlock& b,
                                const std::int32_t* near, std::int32_t count, std::int32_t* scratch,
                                float* density) {
    for (std::int32_t z = b.begin[2]; z < b.end[2]; z += kCloudPart)
        for (std::int32_t y = b.begin[1]; y < b.end[1]; y += kCloudPart)
            for (std::int32_t x = b.begin[0]; x < b.end[0]; x += kCloudPart) {
                CloudBlock part = b;
                const std::int32_t begin[3] = {x, y, z};
                for (int a = 0; a < 3; ++a) {
                    part.begin[a] = begin[a];
                    part.end[a] = min_(begin[a] + kCloudPart, b.end[a]);
                }
                fill_cloud_part<W>(k, part, near, count, scratch, density);
            }
}

/// Fills rows of blocks along x, from [begin, end) of those that k.rows_y go into a layer. Cells
/// clear of the cloud are left as they are.
template <int W>
PILEUS_FN void fill_cumulus(const CumulusParams& k, const CumulusBuffers& b, std::uint32_t begin,
                            std::uint32_t end) {
    std::int32_t *in_row = b.scratch, *in_block = b.scratch + kMaxBubbles;
    for (std::uint32_t r = begin; r < end; ++r) {
        // Leave the outermost layer of cells at zero.
        CloudBlock row{};
        row.begin[0] = 1;
        row.begin[1] = 1 + std::int32_t(r) % k.rows_y * kCumulusBlock;
        row.begin[2] = 1 + std::int32_t(r) / k.rows_y * kCumulusBlock;
        row.end[0] = k.size[0] - 1;
        for (int a = 1; a < 3; ++a) row.end[a] = min_(row.begin[a] + kCumulusBlock, k.size[a] - 1);
        place_block(k, row);
        // Drop what is too far for the whole row first, then for each block.
        const std::int32_t held = cull_spheres<W>(k, row, nullptr, k.count, in_row);
        for (std::int32_t x = 1; held > 0 && x < k.size[0] - 1; x += kCumulusBlock) {
            CloudBlock block = row;
            block.begin[0] = x;
            block.end[0] = min_(x + kCumulusBlock, k.size[0] - 1);
            place_block(k, block);
            const std::int32_t n = cull_spheres<W>(k, block, in_row, held, in_block);
            if (n > 0)
                fill_cloud_block<W>(k, block, in_block, n, b.scratch + 2 * kMaxBubbles, b.density);
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
