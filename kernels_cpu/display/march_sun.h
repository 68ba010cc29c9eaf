// SPDX-License-Identifier: Apache-2.0
// What a march reads of the sun along a ray, and a ray where light that turns within the peak of a
// phase function goes on as it came.
// in: a ray, a step of it -> out: light of the sun there, what is left of the ray.
// docs/methods.md 3, repairs 6 and 7.
#pragma once
#include "kernels_cpu/display/beam.h"
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/display/pixel_light.h"
#include "kernels_cpu/media/phase_table.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The sun's first order along one ray, per unit of the sunlight that arrives.
template <class T>
struct SunAlongRay {
    T phase[kMaxMedia];  // where the peak is apart, without it
    T peak[kMaxMedia];
    bool lit;
    T most;  // of any phase function's mean over the pixel, 1/sr
    BeamAngle<T> angle;
};

template <class T>
PILEUS_FN SunAlongRay<T> sun_along(const MarchParams& k, const Vec<T>& direction) {
    SunAlongRay<T> s{};
    const Vec<T> sun{all<T>(k.sun_travel[0]), all<T>(k.sun_travel[1]), all<T>(k.sun_travel[2])};
    const T turn =
        one_minus_cosine(sun, Vec<T>{T{} - direction.x, T{} - direction.y, T{} - direction.z});
    s.most = most_density(k.camera, direction);
    for (int i = 0; i < kMaxMedia && i < k.media; ++i) {
        s.phase[i] = min_(phase_density(k.phase[i], turn), s.most);
        for (int c = 0; c < 3; ++c) s.lit |= k.sun_source[i][c] > 0.0f;
    }
    if (k.apart != 0) {
        const T within = share_in_peak(turn, k.peak_turn);
        for (int i = 0; i < kMaxMedia && i < k.media; ++i) {
            s.peak[i] = s.phase[i] * within;
            s.phase[i] = s.phase[i] - s.peak[i];
        }
    }
    if (k.beam_sets > 0) s.angle = beam_angle(turn);
    return s;
}

/// A ray where light that turns within the peak of a phase function goes on as it came.
template <class T>
struct ApartRay {
    T left[3] = {all<T>(1.0f), all<T>(1.0f), all<T>(1.0f)};
    T own[3];            // of a step: what it shows, over the share of extinction that counts
    T rest[3];           // that share, by the media at the step
    T share[kMaxMedia];  // theirs
};
template <bool Constant, class T>
PILEUS_FN void apart_step(const MarchParams& k, const MarchBuffers& b, const Corners<T>& at,
                          T density, T optical, ApartRay<T>& r) {
    const std::int32_t* n = k.medium.size;
    for_shares(
        b.parts, std::int64_t(n[0]) * n[1] * n[2], k.media, density,
        [&](const float* grid) { return read_density<Constant>(grid, at); },
        [&](int i, T share) { r.share[i] = share; });
    for (int c = 0; c < 3; ++c) {
        if (c < k.apart) {
            T rest{};
            for (int i = 0; i < k.media; ++i) rest = rest + r.share[i] * k.rest[i][c];
            r.rest[c] = max_(rest, all<T>(1e-6f));
            const T lost = one_minus_exp(optical * r.rest[c]);
            r.own[c] = r.left[c] * lost / r.rest[c];
            r.left[c] = r.left[c] * (1.0f - lost);
        } else {
            r.rest[c] = r.rest[0], r.own[c] = r.own[0], r.left[c] = r.left[0];
        }
    }
}
/// What is left of a ray.
template <class T>
PILEUS_FN T left_of(const MarchParams& k, T transmittance, const ApartRay<T>& r) {
    return k.apart != 0 ? max_(r.left[0], max_(r.left[1], r.left[2])) : transmittance;
}

/// Adds the sun's light where its optical depth is `tau`: to `out` without the peak, to `kept`
/// within it. Nodes hold one depth: the media here stand for those on the way.
template <class T>
PILEUS_FN void add_sun_apart(const MarchParams& k, const MarchBuffers& b, const SunAlongRay<T>& s,
                             const ApartRay<T>& r, T tau, T visible, T (&out)[3], T (&kept)[3]) {
    T beam[3], left[3] = {};
    beam_light(b.beam, k.beam_sets, k.beam_rest, s.angle, s.most, tau, visible, beam);
    const T whole = exp_(T{} - tau) * visible;
    for (int c = 0; c < 3; ++c)
        left[c] = c < k.apart ? exp_(T{} - tau * r.rest[c]) * visible : left[0];
    for (int i = 0; i < k.media; ++i)
        for (int c = 0; c < 3; ++c) {
            const T source = r.share[i] * k.sun_source[i][c];
            out[c] = out[c] + left[c] * s.phase[i] * source;
            kept[c] = kept[c] + (whole * s.peak[i] + beam[c]) * source;
        }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
