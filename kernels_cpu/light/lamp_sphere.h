// SPDX-License-Identifier: Apache-2.0
// Lamps that are spheres: places on them as a point sees them, alike over the solid angle.
// in: a lamp with a radius, places, two numbers in [0, 1) -> out: directions, ways, shares of
// light. docs/lights.md, "Spheres". All of a sphere's radiance, intensity / (pi radius^2), goes
// along each of its directions, times a spot's falloff there; it leaves from the surface: inside
// there is none.
#pragma once
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/light/lamp.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// A sphere as a place outside of it sees it: a cone of even radiance.
template <class T>
struct LampCone {
    Vec<T> way;       // unit, towards its middle
    T distance;       // to the middle, metres
    T sine, versine;  // of the cone's half angle; versine: 1 - cosine
    T share;          // radiance times solid angle over LampParams::light, but for a spot's falloff
};

template <class T>
PILEUS_FN LampCone<T> lamp_cone(const LampParams& lamp, const Vec<T>& from) {
    const Vec<T> v{lamp.at[0] - from.x, lamp.at[1] - from.y, lamp.at[2] - from.z};
    const T square = max_(dot(v, v), all<T>(1e-30f)), distance = sqrt_(square);
    const T inverse = 1.0f / distance;
    const T sine = min_(lamp.radius * inverse, all<T>(1.0f)), sine2 = sine * sine;
    const T per = 1.0f / (1.0f + sqrt_(1.0f - sine2)), share = 2.0f * per / square;
    return {{v.x * inverse, v.y * inverse, v.z * inverse},
            distance,
            sine,
            sine2 * per,
            select(distance > lamp.radius, share, T{})};
}

/// The place on the sphere that `u`, `v` in [0, 1) choose: `distance` to the surface, `share` as if
/// the whole cone had the falloff of this direction.
template <class T>
PILEUS_FN LampSight<T> lamp_place(const LampParams& lamp, const LampCone<T>& cone, T u, T v) {
    const T turn = u * cone.versine;
    const T sine = sqrt_(max_(turn * (2.0f - turn), T{}));
    const SinCos<T> phi = sincos_turns(v);
    const Vec<T> way = turned(cone.way, 1.0f - turn, sine, phi.cosine, phi.sine);
    const T across = cone.distance * sine;
    const T deep = sqrt_(max_(lamp.radius * lamp.radius - across * across, T{}));
    const T distance = max_(cone.distance * (1.0f - turn) - deep, T{});
    const T cosine = T{} - (way.x * lamp.axis[0] + way.y * lamp.axis[1] + way.z * lamp.axis[2]);
    return {way, distance, cone.share * lamp_shape(lamp, cosine)};
}

/// The largest cosine that directions of the cone have with one whose cosine with its axis is
/// given.
template <class T>
PILEUS_FN T most_cosine(const LampCone<T>& cone, T cosine) {
    const T own = 1.0f - cone.versine, sine = sqrt_(max_(1.0f - cosine * cosine, T{}));
    return select(cosine >= own, all<T>(1.0f), cosine * own + sine * cone.sine);
}

/// Not less than the share of any place of the sphere.
template <class T>
PILEUS_FN T most_share(const LampParams& lamp, const LampCone<T>& cone) {
    const T cosine =
        T{} - (cone.way.x * lamp.axis[0] + cone.way.y * lamp.axis[1] + cone.way.z * lamp.axis[2]);
    return cone.share * lamp_shape(lamp, most_cosine(cone, cosine));
}

/// Place `i` of the lamp's spiral of places, turned by `turn` in [0, 1). They are pairs that face
/// each other across the middle, so that what grows evenly across the sphere has its exact mean;
/// of an odd number the last is the middle.
template <class T>
PILEUS_FN LampSight<T> lamp_place(const LampParams& lamp, const LampCone<T>& cone, std::int32_t i,
                                  T turn) {
    constexpr float kHalfGolden = 0.30901699437f;
    const std::int32_t pair = i / 2;
    const bool middle = i + 1 == lamp.places && i % 2 == 0;
    // The middle's part of the solid angle is the innermost.
    const float odd = float(lamp.places % 2), of = float(lamp.places);
    const float u = middle ? 0.0f : (odd + 2.0f * float(pair) + 1.0f) / of;
    const T v = turn + (float(pair) * kHalfGolden + (i % 2 != 0 ? 0.5f : 0.0f));
    return lamp_place(lamp, cone, all<T>(u), v - to_float(floor_int(v)));
}

/// A turn of the spiral for a thing of this number, in [0, 1): no seed, so that it is a part of the
/// method and not noise.
PILEUS_FN float turn_of_spiral(std::uint32_t number, std::uint32_t more) {
    const Key key = make_key(0x7370686572657300u, 0, 0);
    return uniform(threefry(key.k0, key.k1, number, more).a);
}

/// -log of a mean transmittance, from optical depths one after the other: none underflows.
template <class T>
struct MeanDepth {
    T least, sum;  // sum of e^(least - depth)
};
template <class T>
PILEUS_FN void add_depth(MeanDepth<T>& m, T depth, bool first) {
    const T least = first ? depth : min_(m.least, depth);
    m.sum = first ? all<T>(1.0f) : m.sum * exp_(least - m.least) + exp_(least - depth);
    m.least = least;
}
template <class T>
PILEUS_FN T mean_depth(const MeanDepth<T>& m, std::int32_t places) {
    return m.least - log_(m.sum * (1.0f / float(places)));
}

/// A part of a ray about the sphere: what it lies outside, and where the lamp sees half of that.
template <class T>
struct LampStep {
    T at;    // metres along the ray
    T mean;  // of 1 / distance^2 over the whole part, 0 within the sphere
};

template <class T>
PILEUS_FN LampStep<T> lamp_step(const LampParams& lamp, const Vec<T>& from, const Vec<T>& d,
                                T width) {
    const Vec<T> v{lamp.at[0] - from.x, lamp.at[1] - from.y, lamp.at[2] - from.z};
    const T nearest = dot(v, d), radius2 = all<T>(lamp.radius * lamp.radius);
    const Vec<T> up{v.x - d.x * nearest, v.y - d.y * nearest, v.z - d.z * nearest};
    const T square = dot(up, up), half = sqrt_(max_(radius2 - square, T{}));
    // Through the middle the angle is 0 on both sides: a thousandth of the radius beside it is as
    // good.
    const T height = max_(sqrt_(square), 1e-3f * sqrt_(radius2));
    const T in = min_(max_(nearest - half, T{}), width);
    const T out = min_(max_(nearest + half, T{}), width);
    const auto angle = [&](T a, T b) {
        a = a - nearest, b = b - nearest;
        return max_(atan2_turns((b - a) * height, height * height + a * b), T{});
    };
    const T before = angle(T{}, in), after = angle(out, width), sum = before + after;
    const auto first = before >= 0.5f * sum;
    const SinCos<T> turn = sincos_turns(select(first, 0.5f * sum, 0.5f * sum - before));
    const T a = select(first, T{}, out) - nearest;
    const T across = max_(height * turn.cosine - a * turn.sine, all<T>(1e-30f));
    const T t = nearest + height * (height * turn.sine + a * turn.cosine) / across;
    return {min_(max_(t, select(first, T{}, out)), select(first, in, width)),
            sum * 6.28318530717958648f / (height * max_(width, all<T>(1e-30f)))};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
