// SPDX-License-Identifier: Apache-2.0
// Rows of a picture through the air: what it takes away and adds before media, ground and solids,
// and the sky behind them.
// in: AirRowsParams, AirRowsBuffers -> out: the media's light and what is behind, in place.
// docs/atmosphere.md, "In front of things"
#pragma once
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/air_params.h"
#include "kernels_cpu/display/level_air.h"
#include "kernels_cpu/display/march_ray.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Numbers of a texel where lanes are one: each of those that are read by itself.
struct TexelNumbers {
    float v[6];
    constexpr float operator[](int n) const { return v[n]; }
};

template <class T>
PILEUS_FN T load_lanes(const float* from) {
    T v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}

/// Place between entries of a table: the lower one, and how far it is to the next.
template <class T>
struct Between {
    I_of<T> low;
    T part;
};
/// `place` counts entries from 0; the table ends at `last`.
template <class T>
PILEUS_FN Between<T> between_entries(T place, std::int32_t last) {
    Between<T> b;
    b.low = max_(min_(floor_int(place), all<I_of<T>>(last - 1)), I_of<T>{});
    b.part = max_(min_(place - to_float(b.low), all<T>(1.0f)), T{});
    return b;
}

/// Directions of W pixels as the tables see them.
template <class T>
struct AirWay {
    T phase;  ///< of haze
    Between<T> sky_row, sky_column, row, column;
};
template <class T>
PILEUS_FN AirWay<T> air_way(const AirRowsParams& k, const Vec<T>& d) {
    AirWay<T> way;
    const T along = d.x * k.to_sun[0] + d.y * k.to_sun[1] + d.z * k.to_sun[2];
    const T away = max_((1.0f + k.haze_g * k.haze_g) - 2.0f * k.haze_g * along, all<T>(1e-6f));
    way.phase = (kInvFourPi * (1.0f - k.haze_g * k.haze_g)) / (away * sqrt_(away));
    const float sun_side = max_(1.0f - k.to_sun[2] * k.to_sun[2], 0.0f);
    const T sides = sqrt_(max_((1.0f - d.z * d.z) * sun_side, T{}));
    const T east = (along - d.z * k.to_sun[2]) / max_(sides, all<T>(1e-9f));
    const T half = sqrt_(
        max_(min_(0.5f - 0.5f * select(sides > 1e-6f, east, all<T>(1.0f)), all<T>(1.0f)), T{}));
    const auto up = d.z >= k.horizon;
    const T off = sqrt_(max_(
        select(up, (d.z - k.horizon) / (1.0f - k.horizon), (k.horizon - d.z) / (1.0f + k.horizon)),
        T{}));
    const T ups = off * float(k.ups - 1), downs = (1.0f - off) * float(k.downs - 1);
    // No row lies between the last below the horizon and the first above it.
    way.sky_row = between_entries(select(up, ups, downs), k.ups - 1);
    const Between<T> low = between_entries(downs, k.downs - 1);
    way.sky_row.low = select(up, way.sky_row.low + k.downs, low.low);
    way.sky_row.part = select(up, way.sky_row.part, low.part);
    way.sky_column = between_entries(half * float(k.turns - 1), k.turns - 1);
    const float level = 0.5f * float(k.rows - 1);
    const T rise = sqrt_(abs_(d.z)) * level;
    way.row = between_entries(select(d.z < 0.0f, level - rise, level + rise), k.rows - 1);
    way.column = between_entries(half * float(k.columns - 1), k.columns - 1);
    return way;
}

/// How far the slices of a direction reach: to the level ground, to the top of the air, or so far
/// that no air is left to see.
template <class T>
PILEUS_FN T air_reach(const AirRowsParams& k, T rise) {
    const T steep = max_(abs_(rise), all<T>(1e-9f));
    const T way = select(rise < 0.0f, k.height / steep, k.room / steep);
    return max_(min_(way, all<T>(k.reach)), all<T>(1.0f));
}

/// What the air takes of light from a distance, and leaves of it: exact for level air.
template <class T>
struct AirDepth {
    T taken[3], left[3];
};
template <class T>
PILEUS_FN AirDepth<T> air_depth(const AirRowsParams& k, T rise, T metres) {
    const T way = min_(metres, air_reach(k, rise)) * 1e-3f;
    const T from = all<T>(k.height * 1e-3f);
    const LevelAir<T> mean = level_air(from, from + way * rise);
    AirDepth<T> out;
    for (int n = 0; n < 3; ++n) {
        const T depth =
            way * (k.rayleigh[n] * mean.air + k.haze[n] * mean.haze + k.ozone[n] * mean.ozone);
        out.taken[n] = one_minus_exp(depth);
        out.left[n] = exp_(T{} - depth);
    }
    return out;
}

/// Slices lie close at both ends of the reach: at shares 2 q^2, and 1 - 2 (1 - q)^2 from the middle
/// on, q in even steps; between them the light over what is taken is linear.
template <class T>
PILEUS_FN T slice_share(T q) {
    const T rest = 1.0f - q;
    return select(q < 0.5f, 2.0f * q * q, 1.0f - 2.0f * rest * rest);
}
template <class T>
PILEUS_FN Between<T> slice_at(const AirRowsParams& k, T rise, T metres) {
    const float last = float(k.slices - 1);
    const T share = min_(metres / air_reach(k, rise), all<T>(1.0f));
    const T q = select(share < 0.5f, sqrt_(0.5f * share), 1.0f - sqrt_(0.5f * (1.0f - share)));
    Between<T> b = between_entries(q * last, k.slices - 1);
    const T low = slice_share(to_float(b.low) * (1.0f / last));
    const T high = slice_share((to_float(b.low) + 1.0f) * (1.0f / last));
    b.part = max_(min_((share - low) / (high - low), all<T>(1.0f)), T{});
    return b;
}

/// Between four texels: their numbers side by side, or one by one where L, the lanes, is 1.
template <int L>
PILEUS_FN auto mix_texels(const float* row, std::int64_t next, float fx, float fy) {
    if constexpr (L == 1) {
        TexelNumbers out;
        for (int n = 0; n < 6; ++n) {
            const float a = row[n], b = row[kAirTexel + n];
            const float c = row[next + n], d = row[next + kAirTexel + n];
            const float top = a + (b - a) * fx, low = c + (d - c) * fx;
            out.v[n] = top + (low - top) * fy;
        }
        return out;
    } else {
        static_assert(L == kAirTexel, "numbers of a texel side by side");
        using T = F<L>;
        const T a = load_lanes<T>(row), b = load_lanes<T>(row + kAirTexel);
        const T c = load_lanes<T>(row + next), d = load_lanes<T>(row + next + kAirTexel);
        const T top = a + (b - a) * fx, low = c + (d - c) * fx;
        return top + (low - top) * fy;
    }
}
template <int L, class Texel>
PILEUS_FN Texel between_texels(const Texel& near, const Texel& far, float share) {
    if constexpr (L == 1) {
        TexelNumbers out;
        for (int n = 0; n < 6; ++n) out.v[n] = near[n] + (far[n] - near[n]) * share;
        return out;
    } else {
        return near + (far - near) * share;
    }
}

/// Light that the air sends over the share that it takes, of one pixel.
template <class T>
PILEUS_FN void air_seen(const AirRowsParams& k, const AirRowsBuffers& b, const AirWay<T>& way,
                        const Between<T>& slice, int i, float (&light)[3]) {
    const std::int64_t row = lane(way.row.low, i), column = lane(way.column.low, i);
    const std::int64_t s = lane(slice.low, i);
    const float fx = lane(way.column.part, i), fy = lane(way.row.part, i), fs = lane(slice.part, i);
    const std::int64_t next = std::int64_t(k.columns) * kAirTexel, sheet = next * k.rows;
    const float* at = b.air + s * sheet + row * next + column * kAirTexel;
    constexpr int L = width_of<T>;
    const auto v = between_texels<L>(mix_texels<L>(at, next, fx, fy),
                                     mix_texels<L>(at + sheet, next, fx, fy), fs);
    const float phase = lane(way.phase, i);
    for (int n = 0; n < 3; ++n) light[n] = (v[n] + phase * v[3 + n]) * k.above[n];
}

/// The sky of one pixel.
template <class T>
PILEUS_FN void sky_seen(const AirRowsParams& k, const AirRowsBuffers& b, const AirWay<T>& way,
                        int i, float (&light)[3]) {
    const std::int64_t next = std::int64_t(k.turns) * kAirTexel;
    const float* at = b.sky + lane(way.sky_row.low, i) * next +
                      std::int64_t(lane(way.sky_column.low, i)) * kAirTexel;
    const auto v =
        mix_texels<width_of<T>>(at, next, lane(way.sky_column.part, i), lane(way.sky_row.part, i));
    const float phase = lane(way.phase, i);
    for (int n = 0; n < 3; ++n) light[n] = (v[n] + phase * v[3 + n]) * k.above[n];
}

/// Pixels that are looked at together, on every instruction set.
constexpr int kAirRun = 8;

/// L pixels, each for itself.
template <int L>
PILEUS_FN void air_pixels(const AirRowsParams& k, const AirRowsBuffers& b, std::int32_t x,
                          std::int32_t y) {
    using T = F<L>;
    const std::int64_t pixels = std::int64_t(k.camera.width) * k.camera.height;
    const std::int64_t first = std::int64_t(y) * k.camera.width + x;
    const std::int32_t real = k.camera.width - x < L ? k.camera.width - x : L;
    const Ray<T> ray = camera_ray(k.camera, to_float(iota<I<L>>() + x), all<T>(float(y)));
    const AirWay<T> way = air_way<T>(k, ray.direction);
    const T through = take_lanes<T>(b.transmittance + first, real);
    T opaque = all<T>(__builtin_inff());
    if (k.solid != 0) opaque = take_lanes<T>(b.opaque_depth + first, real);
    // Where half of the medium is not hidden, it counts as in the middle of its box.
    const Segment<T> box = clip_to_medium(k.medium, ray);
    const T middle = 0.5f * (box.enter + max_(box.leave, box.enter));
    const T half = take_lanes<T>(b.half_depth + first, real);
    const T metres = min_(select(half < 1e30f, half, middle), opaque);
    const T to_media = max_(metres, T{});
    const Between<T> media = slice_at(k, ray.direction.z, to_media),
                     solid = slice_at(k, ray.direction.z, opaque);
    const AirDepth<T> media_depth = air_depth(k, ray.direction.z, to_media),
                      solid_depth = air_depth(k, ray.direction.z, opaque);
    for (int i = 0; i < real; ++i) {
        const std::int64_t at = first + i;
        const float share = lane(through, i), hidden = 1.0f - share;
        float* const behind = b.behind + at;
        if (hidden > 0.0f) {
            float air[3];
            air_seen(k, b, way, media, i, air);
            for (int n = 0; n < 3; ++n) {
                float& light = b.light[n * pixels + at];
                const float left = lane(media_depth.left[n], i);
                light = light * left + air[n] * lane(media_depth.taken[n], i) * hidden;
                if (b.dimmed != nullptr) b.dimmed[n * pixels + at] = left;
            }
        }
        const float part = k.through != 0 ? share : 1.0f;
        if (lane(opaque, i) < 1e30f) {
            float air[3];
            air_seen(k, b, way, solid, i, air);
            for (int n = 0; n < 3; ++n)
                behind[n * pixels] = behind[n * pixels] * lane(solid_depth.left[n], i) +
                                     part * (air[n] * lane(solid_depth.taken[n], i));
        } else {
            float sky[3];
            sky_seen(k, b, way, i, sky);
            for (int n = 0; n < 3; ++n) behind[n * pixels] = part * sky[n];
        }
        if (b.kept == nullptr) continue;
        const bool solid_here = lane(opaque, i) < 1e30f;
        for (int n = 0; n < 3; ++n)
            b.kept[n * pixels + at] = solid_here ? lane(solid_depth.left[n], i) : 0.0f;
    }
}

/// A run of pixels, or what is left of one.
template <int L>
PILEUS_FN void air_run(const AirRowsParams& k, const AirRowsBuffers& b, std::int32_t x,
                       std::int32_t y) {
    for (std::int32_t i = 0; i < kAirRun && x + i < k.camera.width; i += L)
        air_pixels<L>(k, b, x + i, y);
}

/// What a run of pixels without media before it shows.
enum class AirRun { kMixed, kSky, kSolid };
template <int L>
PILEUS_FN AirRun run_kind(const AirRowsParams& k, const AirRowsBuffers& b, std::int64_t first) {
    using T = F<L>;
    for (int i = 0; i < kAirRun; i += L)
        if (any(load_lanes<T>(b.transmittance + first + i) < 1.0f)) return AirRun::kMixed;
    if (k.solid == 0) return AirRun::kSky;
    const float* const opaque = b.opaque_depth + first;
    bool sky = false, solid = false;
    for (int i = 0; i < kAirRun; i += L) {
        const auto far = load_lanes<T>(opaque + i) >= 1e30f;
        sky = sky || any(far);
        solid = solid || any(lnot(far));
    }
    if (!solid) return AirRun::kSky;
    if (sky) return AirRun::kMixed;
    float least = opaque[0], most = least;
    for (int i = 1; i < kAirRun; ++i) {
        least = min_(least, opaque[i]);
        most = max_(most, opaque[i]);
    }
    return most <= 1.1f * least ? AirRun::kSolid : AirRun::kMixed;
}

/// L pixels from number i on of a line between both ends of a run.
template <int L>
PILEUS_FN F<L> line(int i, float begin, float end) {
    const F<L> part = to_float(iota<I<L>>() + i) * (1.0f / float(kAirRun - 1));
    return begin + (end - begin) * part;
}

/// Four runs: where they are alike, both ends of a run tell the light that is between.
template <int L>
PILEUS_FN void air_runs(const AirRowsParams& k, const AirRowsBuffers& b, std::int32_t x,
                        std::int32_t y) {
    using T = F<L>;
    const std::int64_t pixels = std::int64_t(k.camera.width) * k.camera.height;
    const std::int64_t first = std::int64_t(y) * k.camera.width + x;
    // The ends of all runs, L side by side.
    AirWay<T> way[kAirRun / L];
    Between<T> solid[kAirRun / L];
    for (int g = 0; g < kAirRun / L; ++g) {
        const I<L> point = iota<I<L>>() + g * L;
        const I<L> column = (point >> 1) * kAirRun + (point & 1) * (kAirRun - 1) + x;
        const Ray<T> ray = camera_ray(k.camera, to_float(column), all<T>(float(y)));
        way[g] = air_way<T>(k, ray.direction);
        T opaque = all<T>(__builtin_inff());
        if (k.solid != 0)
            for (int i = 0; i < L; ++i)
                set_lane(opaque, i, b.opaque_depth[first + lane(column, i) - x]);
        solid[g] = slice_at(k, ray.direction.z, opaque);
    }
    for (int run = 0; run < kAirRun / 2; ++run) {
        const std::int64_t at = first + run * kAirRun;
        const AirRun kind = run_kind<L>(k, b, at);
        if (kind == AirRun::kMixed) {
            air_run<L>(k, b, x + run * kAirRun, y);
            continue;
        }
        float ends[2][3];
        for (int e = 0; e < 2; ++e) {
            const int g = (2 * run + e) / L, i = (2 * run + e) % L;
            if (kind == AirRun::kSky)
                sky_seen(k, b, way[g], i, ends[e]);
            else
                air_seen(k, b, way[g], solid[g], i, ends[e]);
        }
        for (int i = 0; i < kAirRun; i += L) {
            AirDepth<T> depth{};
            if (kind == AirRun::kSolid) {
                const I<L> column = iota<I<L>>() + (x + run * kAirRun + i);
                const Ray<T> own = camera_ray(k.camera, to_float(column), all<T>(float(y)));
                depth = air_depth(k, own.direction.z, load_lanes<T>(b.opaque_depth + at + i));
            }
            for (int n = 0; n < 3; ++n) {
                float* const behind = b.behind + n * pixels + at + i;
                T light = line<L>(i, ends[0][n], ends[1][n]);
                if (kind == AirRun::kSolid)
                    light = load_lanes<T>(behind) * depth.left[n] + light * depth.taken[n];
                __builtin_memcpy(behind, &light, sizeof light);
                if (b.kept == nullptr) continue;
                const T left = kind == AirRun::kSolid ? depth.left[n] : T{};
                __builtin_memcpy(b.kept + n * pixels + at + i, &left, sizeof left);
            }
        }
    }
}

/// Runs are as wide on every instruction set: a run of lanes, or one pixel after the other.
template <int W>
PILEUS_FN void air_rows(const AirRowsParams& k, const AirRowsBuffers& b, std::uint32_t begin,
                        std::uint32_t end) {
    constexpr std::int32_t kRuns = kAirRun * kAirRun / 2;
    constexpr int L = W == 1 ? 1 : kAirRun;
    for (std::uint32_t y = begin; y < end; ++y) {
        std::int32_t x = 0;
        for (; x + kRuns <= k.camera.width; x += kRuns) air_runs<L>(k, b, x, std::int32_t(y));
        for (; x < k.camera.width; x += kAirRun) air_run<L>(k, b, x, std::int32_t(y));
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
