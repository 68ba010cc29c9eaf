// SPDX-License-Identifier: Apache-2.0
// Light of points, spots and parallel lights at a place, without what dims it on its way.
// in: a lamp, places -> out: directions, distances, shares of its light.
// docs/lights.md, "What the keys mean".
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/light/lamp_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Way of a parallel light, metres.
constexpr float kEndlessWay = 3e38f;

/// A lamp as a place sees it: irradiance on a plane facing it is `share` of LampParams::light.
template <class T>
struct LampSight {
    Vec<T> way;  // unit, towards it
    T distance;  // metres
    T share;
};

/// Share of its intensity that a spot sends along an angle of this cosine with its axis.
template <class T>
PILEUS_FN T lamp_shape(const LampParams& lamp, T cosine) {
    const T x = min_(max_((cosine - lamp.edge) * lamp.slope, T{}), all<T>(1.0f));
    return x * x * (3.0f - 2.0f * x);
}

template <class T>
PILEUS_FN LampSight<T> see_lamp(const LampParams& lamp, const Vec<T>& from) {
    if (lamp.parallel != 0)
        return {{all<T>(lamp.at[0]), all<T>(lamp.at[1]), all<T>(lamp.at[2])},
                all<T>(kEndlessWay),
                all<T>(1.0f)};
    const Vec<T> v{lamp.at[0] - from.x, lamp.at[1] - from.y, lamp.at[2] - from.z};
    const T square = max_(dot(v, v), all<T>(1e-30f)), distance = sqrt_(square);
    const T inverse = 1.0f / distance;
    const Vec<T> way{v.x * inverse, v.y * inverse, v.z * inverse};
    const T cosine = T{} - (way.x * lamp.axis[0] + way.y * lamp.axis[1] + way.z * lamp.axis[2]);
    return {way, distance, lamp_shape(lamp, cosine) / max_(square, all<T>(lamp.least_square))};
}

/// Part of a ray within a sphere about a lamp, and the angle under which the lamp sees it. Points
/// are drawn evenly by that angle (Kulla and Fajardo 2012), which takes 1 / distance^2 away.
template <class T>
struct LampChord {
    T nearest;    // metres along the ray to the point next to the lamp
    T height;     // of the lamp over the ray, at least its radius
    T from, to;   // metres along the ray; empty where to <= from
    T angle;      // turns
    Vec<T> lamp;  // its place
};

template <class T>
PILEUS_FN LampChord<T> lamp_chord(const LampParams& lamp, const Vec<T>& o, const Vec<T>& d, T end,
                                  float sphere) {
    LampChord<T> c;
    c.lamp = {all<T>(lamp.at[0]), all<T>(lamp.at[1]), all<T>(lamp.at[2])};
    const Vec<T> v{c.lamp.x - o.x, c.lamp.y - o.y, c.lamp.z - o.z};
    c.nearest = dot(v, d);
    // From the nearest point itself: the difference of two squares would lose it.
    const Vec<T> up{v.x - d.x * c.nearest, v.y - d.y * c.nearest, v.z - d.z * c.nearest};
    const T square = dot(up, up);
    const T half = sqrt_(max_(sphere * sphere - square, T{}));
    c.height = sqrt_(max_(square, all<T>(lamp.least_square)));
    c.from = max_(c.nearest - half, T{});
    c.to = min_(c.nearest + half, end);
    const T a = c.from - c.nearest, b = c.to - c.nearest;
    const T angle = atan2_turns((b - a) * c.height, c.height * c.height + a * b);
    c.angle = select((c.to > c.from) & (half > 0.0f), max_(angle, T{}), T{});
    return c;
}

/// The point, metres along the ray, at the share `u` of the chord's angle, and metres of the chord
/// per unit of `u` there.
template <class T>
PILEUS_FN T point_of_chord(const LampChord<T>& c, T u, T& metres) {
    const SinCos<T> turn = sincos_turns(c.angle * u);
    const T a = c.from - c.nearest;
    const T across = max_(c.height * turn.cosine - a * turn.sine, all<T>(1e-30f));
    const T t = c.nearest + c.height * (c.height * turn.sine + a * turn.cosine) / across;
    const T at = min_(max_(t, c.from), c.to), off = at - c.nearest;
    metres = c.angle * 6.28318530717958648f * (c.height * c.height + off * off) / c.height;
    return at;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
