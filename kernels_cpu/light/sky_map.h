// SPDX-License-Identifier: Apache-2.0
// A sky given as a latitude-longitude image: what the eye sees of it, and photons that come from
// it. in: an image and its tables (src/world/light/sky_map.h) -> out: radiance per direction;
// directions. docs/methods.md 3 "Sky map": bilinear between texels, in the picture and in the light
// alike.
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/core/vec.h"

namespace pileus {

/// Texel (row, column) has its centre at row + 1/2 rows from the zenith. Rows that lie wholly below
/// the ground's horizon are not in `rows`. No columns: no map.
struct SkyMapView {
    std::int32_t rows, columns;
    std::int32_t planes;             ///< 1 (grey) or 3
    std::int32_t row_bit;            ///< highest power of two below rows; 0 for one row
    std::int32_t column_bit;         ///< the same for the columns
    float foot;                      ///< rows from the zenith to where the sky ends
    float rows_per_turn;             ///< of the angle from the zenith
    float turn_of_first;             ///< azimuth of column 0's left edge, turns from north to east
    const float* radiance;           ///< [plane][row][column]
    const std::int32_t* row_cdf;     ///< power of rows 0..i in units of 2^-31, unsigned
    const std::int32_t* column_cdf;  ///< [row][column], the same within each row
    const float* row_bound;          ///< [2][row]: most of sin^2 and of |sin cos| on the row
    const float* column_bound;       ///< [2][column]: most of |sin| and |cos| of the azimuth
};

/// Draws until one is accepted; the last counts anyway (docs/methods.md 3 "Sky map").
constexpr std::uint32_t kMapTries = 128;
/// Their random numbers, beyond those of any event of the photon.
constexpr std::uint32_t kMapCounter = 0xc0000000u;

inline namespace PILEUS_ISA {

/// How many of the `count` rising bounds from `base` on lie at or below `word`, the last left out.
template <class II, class UU>
PILEUS_FN II pick(const std::int32_t* cdf, II base, std::int32_t count, std::int32_t bit, UU word) {
    II found{};
    for (; bit > 0; bit >>= 1) {
        const II next = found + bit;
        const II at = base + min_(next, all<II>(count)) - 1;
        const UU bound = reinterpret<UU>(gather(cdf, at));
        found = select((next < count) & (bound <= word), next, found);
    }
    return found;
}

/// From -1 to 1 with density 1 - |t|, out of u in [0, 1).
template <class T>
PILEUS_FN T tent(T u) {
    const auto low = u < 0.5f;
    const T side = 1.0f - sqrt_(2.0f * select(low, u, 1.0f - u));
    return select(low, T{} - side, side);
}

/// Where a photon of the map comes from: its texel, the direction towards the sky.
template <class T>
struct MapDraw {
    I_of<T> texel;
    Vec<T> to_sky;
};

/// Draws from radiance times the silhouette of a box whose faces across x, y, z have the areas
/// `face`. Lanes outside `m` come back unspecified.
template <class T, class UU>
PILEUS_FN MapDraw<T> draw_from_map(const SkyMapView& map, const float (&face)[3], Key key,
                                   UU number, UU row_word, UU column_word, M_of<T> m) {
    using II = I_of<T>;
    const II row = pick(map.row_cdf, II{}, map.rows, map.row_bit, row_word >> 1);
    const II first = row * map.columns;
    const II column = pick(map.column_cdf, first, map.columns, map.column_bit, column_word >> 1);
    const T sine2 = gather(map.row_bound, row), mixed = gather(map.row_bound, row + map.rows);
    const T east = gather(map.column_bound, column);
    const T north = gather(map.column_bound, column + map.columns);
    const T bound = sine2 * (east * face[0] + north * face[1]) + mixed * face[2];
    const float turns_per_row = 1.0f / map.rows_per_turn;
    const float turns_per_column = 1.0f / float(map.columns);

    // The texel's share of a bilinear image is a tent around its centre; what passes the zenith or
    // the sky's foot folds back, as the outermost rows reach up to there unchanged.
    MapDraw<T> out{first + column, {}};
    for (std::uint32_t i = 0; i < kMapTries && any(m); ++i) {
        const Words<UU> w = threefry(key.k0, key.k1, number, all<UU>(kMapCounter + 2 * i));
        const Words<UU> luck = threefry(key.k0, key.k1, number, all<UU>(kMapCounter + 2 * i + 1));
        T p = to_float(row) + 0.5f + tent(uniform(w.a));
        p = abs_(select(p > map.foot, 2.0f * map.foot - p, p));
        const T q = to_float(column) + 0.5f + tent(uniform(w.b));
        const T turn = q * turns_per_column + map.turn_of_first;
        const SinCos<T> theta = sincos_turns(p * turns_per_row);
        const SinCos<T> phi = sincos_turns(turn - to_float(floor_int(turn)));
        const T side = abs_(phi.sine) * face[0] + abs_(phi.cosine) * face[1];
        const T flux = theta.sine * (theta.sine * side + abs_(theta.cosine) * face[2]);
        const float still_choosing = i + 1 == kMapTries ? 0.0f : 1.0f;
        const auto taken = m & (uniform(luck.a) * (bound * still_choosing) <= flux);
        out.to_sky.x = select(taken, theta.sine * phi.sine, out.to_sky.x);
        out.to_sky.y = select(taken, theta.sine * phi.cosine, out.to_sky.y);
        out.to_sky.z = select(taken, theta.cosine, out.to_sky.z);
        m = m & lnot(taken);
    }
    return out;
}

/// A texel's radiance in one channel over that in its brightest: what a photon of it carries.
template <class II>
PILEUS_FN auto texel_share(const SkyMapView& map, II texel, int channel) {
    using T = F_of<II>;
    if (map.planes == 1) return all<T>(1.0f);
    const std::int32_t plane = map.rows * map.columns;
    const T r = gather(map.radiance, texel), g = gather(map.radiance, texel + plane),
            b = gather(map.radiance, texel + 2 * plane);
    const T own = channel == 0 ? r : (channel == 1 ? g : b);
    return own / max_(max_(max_(r, g), b), all<T>(1e-30f));
}

/// Where a direction falls among the centres of texels: rows `upper` and `lower`, columns `west`
/// and `east`, and the shares of the latter two.
template <class T>
struct MapPlace {
    I_of<T> upper, lower, west, east;
    T down, right;
};
template <class T>
PILEUS_FN MapPlace<T> place_on_map(const SkyMapView& map, const Vec<T>& d) {
    using II = I_of<T>;
    const T theta = atan2_turns(sqrt_(d.x * d.x + d.y * d.y), d.z);
    const T p = min_(max_(theta * map.rows_per_turn - 0.5f, T{}), all<T>(float(map.rows - 1)));
    const II upper = to_int(p), lower = min_(upper + 1, all<II>(map.rows - 1));
    const T turn = atan2_turns(d.x, d.y) - map.turn_of_first;
    const T q = (turn - to_float(floor_int(turn))) * float(map.columns) - 0.5f;
    const II whole = floor_int(q);
    const II last = all<II>(map.columns - 1);
    const II west = select(whole < 0, last, min_(whole, last));
    const II east = select(west == last, II{}, west + 1);
    return {upper, lower, west, east, p - to_float(upper), q - to_float(whole)};
}

/// A plane of texels read there, bilinearly; never negative.
template <class T>
PILEUS_FN T read_map(const float* plane, const SkyMapView& map, const MapPlace<T>& at) {
    const T a = gather(plane, at.upper * map.columns + at.west);
    const T b = gather(plane, at.upper * map.columns + at.east);
    const T e = gather(plane, at.lower * map.columns + at.west);
    const T f = gather(plane, at.lower * map.columns + at.east);
    const T above = a + (b - a) * at.right, below = e + (f - e) * at.right;
    return max_(above + (below - above) * at.down, T{});
}

/// Radiance seen along `d`, a unit vector: three channels.
template <class T>
PILEUS_FN Vec<T> map_radiance(const SkyMapView& map, const Vec<T>& d) {
    const MapPlace<T> at = place_on_map(map, d);
    const std::int64_t plane = std::int64_t(map.rows) * map.columns;
    const T first = read_map(map.radiance, map, at);
    if (map.planes == 1) return {first, first, first};
    return {first, read_map(map.radiance + plane, map, at),
            read_map(map.radiance + 2 * plane, map, at)};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
