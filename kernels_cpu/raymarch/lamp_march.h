// SPDX-License-Identifier: Apache-2.0
// Light of point, spot and parallel lights scattered once, or by octaves too, and what the media
// emit unscattered, added up along each pixel's ray. in: lamps, a medium -> out: optical depths to
// each lamp on nodes; light added to planes. docs/lights.md, "By marching": 1 / distance^2 is
// integrated over each step by the angle that the lamp sees of it, so that a lamp beside the ray
// needs no finer steps.
#pragma once
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/beam.h"
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/display/pixel_light.h"
#include "kernels_cpu/light/lamp_sphere.h"
#include "kernels_cpu/raymarch/lamp_surface.h"
#include "kernels_cpu/raymarch/raymarch_light.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Optical depth between places (metres) and a lamp.
template <class T>
PILEUS_FN T depth_to_lamp(const MediumView& m, const Vec<T>& from, const LampSight<T>& sight,
                          M_of<T> wanted) {
    const Ray<T> ray{from, sight.way};
    const Segment<T> box = clip_to_medium(m, ray);
    const T leave = select(wanted, min_(box.leave, sight.distance), box.enter);
    if (m.constant != 0) return density_along<true>(m, ray, box.enter, leave) * m.sigma;
    return density_along<false>(m, ray, box.enter, leave) * m.sigma;
}

/// The same for the light of a sphere: the depth of the mean transmittance to its places.
template <class T>
PILEUS_FN T depth_to_sphere(const MediumView& m, const Vec<T>& from, const LampParams& lamp, T turn,
                            M_of<T> wanted) {
    const LampCone<T> cone = lamp_cone(lamp, from);
    MeanDepth<T> mean{};
    for (std::int32_t i = 0; i < lamp.places; ++i)
        add_depth(mean, depth_to_lamp(m, from, lamp_place(lamp, cone, i, turn), wanted), i == 0);
    return mean_depth(mean, lamp.places);
}

template <int W>
PILEUS_FN void lamp_depth_rows(const LampMarchParams& k, const LampMarchBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const std::int32_t nx = k.nodes.size[0], ny = k.nodes.size[1], nz = k.nodes.size[2];
    for (std::uint32_t row = begin; row < end; ++row) {
        const std::int32_t at = std::int32_t(row) % (ny * nz);
        const LampParams& lamp = b.lamps[std::int32_t(row) / (ny * nz)];
        const float y = (float(at % ny) + 0.5f) / k.nodes.per_metre[1];
        const float z = (float(at / ny) + 0.5f) / k.nodes.per_metre[2];
        for (std::int32_t x = 0; x < nx; x += W) {
            const I<W> i = iota<I<W>>() + x;
            const Vec<T> p{(to_float(i) + 0.5f) / k.nodes.per_metre[0], all<T>(y), all<T>(z)};
            T tau;
            if (lamp.radius > 0.0f) {
                T turn{};
                for (int l = 0; l < W; ++l)
                    set_lane(turn, l, turn_of_spiral(std::uint32_t(x + l), row));
                tau = depth_to_sphere(k.medium, p, lamp, turn, i < nx);
            } else {
                tau = depth_to_lamp(k.medium, p, see_lamp(lamp, p), i < nx);
            }
            for (int l = 0; l < W && x + l < nx; ++l)
                b.optical_depth[std::int64_t(row) * nx + x + l] = lane(tau, l);
        }
    }
}

/// A lamp's light on a step of `width` metres that begins at `from`: where it is looked at, the
/// direction, and the mean irradiance per unit of the lamp's light.
template <class T>
PILEUS_FN LampSight<T> lamp_over_step(const LampParams& lamp, const Vec<T>& from, const Vec<T>& d,
                                      T width, Vec<T>& place) {
    T t = 0.5f * width, mean = all<T>(1.0f);
    if (lamp.radius > 0.0f) {
        const LampStep<T> step = lamp_step(lamp, from, d, width);
        place = {from.x + d.x * step.at, from.y + d.y * step.at, from.z + d.z * step.at};
        const LampCone<T> cone = lamp_cone(lamp, place);
        // Of the cone's share over 1 / distance^2, which is the mean's.
        return {cone.way, cone.distance, step.mean * (cone.share * cone.distance * cone.distance)};
    }
    if (lamp.parallel == 0) {
        // No sphere: the whole step counts.
        const LampChord<T> chord = lamp_chord(lamp, from, d, width, 1e18f);
        T metres;
        t = point_of_chord(chord, all<T>(0.5f), metres);
        mean = metres / max_(width, all<T>(1e-30f));
    }
    place = {from.x + d.x * t, from.y + d.y * t, from.z + d.z * t};
    LampSight<T> sight = see_lamp(lamp, place);
    sight.share = sight.share * mean;
    return sight;
}

/// Light of a lamp that scatterings within the peak have left in its beam (docs/methods.md 3,
/// repair 6), per unit, where its optical depth is `tau`. Of light that spreads from a point, turns
/// near it count for less in the end: the variance of the angle is that of parallel light times (1
/// + u + u^2) / 3, u the share of the way before the medium.
template <class T>
PILEUS_FN void lamp_beam(const LampMarchParams& k, const LampMarchBuffers& b,
                         const LampParams& lamp, const Vec<T>& place, const LampSight<T>& sight,
                         T turn, T most, T tau, T weight, T (&out)[3]) {
    const BeamAngle<T> angle = beam_angle(turn);
    const T light = weight * sight.share;
    beam_light(b.beam, k.beam_sets, k.beam_rest, angle, most, tau, light, out);
    if (lamp.parallel != 0 || k.beam_points == 0) return;
    const Segment<T> box = clip_to_medium(k.medium, Ray<T>{place, sight.way});
    const T u =
        1.0f - min_(max_(box.leave, T{}) / max_(sight.distance, all<T>(1e-30f)), all<T>(1.0f));
    const T parallel = 0.5f * (u + u * u);
    T point[3];
    beam_light(b.beam + k.beam_sets * kBeamNumbers, k.beam_sets, k.beam_rest, angle, most, tau,
               light, point);
    for (int c = 0; c < 3; ++c) out[c] = point[c] + parallel * (out[c] - point[c]);
}

/// A ray whose light is apart from what turns within the peak of a phase function.
template <class T>
struct ThinRay {
    T left[3] = {all<T>(1.0f), all<T>(1.0f), all<T>(1.0f)};
    T rest[3], own[3];  ///< of a step: share of extinction that counts; what it shows, over that
};
template <class T>
PILEUS_FN void thin_step(const LampMarchParams& k, const T (&share)[kMaxMedia], T optical,
                         ThinRay<T>& thin) {
    for (int c = 0; c < 3; ++c) {
        T rest{};
        for (int i = 0; i < k.media; ++i) rest = rest + share[i] * k.rest[i][c];
        thin.rest[c] = max_(rest, all<T>(1e-6f));
        const T depth = optical * thin.rest[c];
        thin.own[c] = thin.left[c] * one_minus_exp(depth) / thin.rest[c];
        thin.left[c] = thin.left[c] * exp_(T{} - depth);
    }
}
template <class T>
PILEUS_FN T left_of(const LampMarchParams& k, T seen, const ThinRay<T>& thin) {
    return k.ordinates != 0 ? max_(thin.left[0], max_(thin.left[1], thin.left[2])) : seen;
}

/// A lamp's light scattered once by more than the peak, and by it alone (docs/ordinates.md, "The
/// march"). Nodes hold one depth: the media here stand for those on the way.
template <class T>
PILEUS_FN void add_apart(const LampMarchParams& k, const LampMarchBuffers& b,
                         const LampParams& lamp, const Vec<T>& place, const LampSight<T>& sight,
                         const Vec<T>& d, T most, T tau, T weight, M_of<T> lit,
                         const T (&share)[kMaxMedia], const ThinRay<T>& thin, T (&colour)[3]) {
    const T turn = one_minus_cosine(d, sight.way);
    const T within = share_in_peak(turn, k.peak_turn);
    const T whole = weight * sight.share * exp_(T{} - tau);
    T kept[3], apart[3];
    lamp_beam(k, b, lamp, place, sight, turn, most, tau, weight, kept);
    for (int c = 0; c < 3; ++c)
        apart[c] = thin.own[c] * sight.share * exp_(T{} - tau * thin.rest[c]);
    for (int i = 0; i < k.media; ++i) {
        const T phase = min_(phase_density(k.phase[i], turn), most), peak = phase * within;
        for (int c = 0; c < 3; ++c) {
            const T light = apart[c] * (phase - peak) + whole * peak + kept[c];
            colour[c] =
                colour[c] + select(lit, light * share[i], T{}) * (k.albedo[i][c] * lamp.light[c]);
        }
    }
}

template <int W, bool Constant>
PILEUS_FN void march_lamps(const LampMarchParams& k, const LampMarchBuffers& b,
                           const Ray<F<W>>& ray, F<W> enter, F<W> leave, F<W> (&colour)[3]) {
    using T = F<W>;
    const MediumView& m = k.medium;
    const std::int64_t nodes = std::int64_t(k.nodes.size[0]) * k.nodes.size[1] * k.nodes.size[2];
    const std::int64_t voxels = std::int64_t(m.size[0]) * m.size[1] * m.size[2];
    const T most = most_density(k.camera, ray.direction);
    T seen = all<T>(1.0f);
    ThinRay<T> thin;
    Pace<T> pace;
    march_ray<Constant>(
        m, ray, enter, leave, pace, [&](M<W> dense, T t, T width, const Vec<T>& p, const Vec<T>&) {
            if (!any(dense)) return left_of(k, seen, thin) < k.cut;
            const Corners<T> at = density_corners<Constant>(m, p);
            const T density = read_density<Constant>(m.density, at);
            const T optical = select(dense, density * (m.sigma * width), T{});
            pace.inside = optical > 0.0f;
            const T weight = seen * one_minus_exp(optical);
            const Vec<T> from = along(ray, t - 0.5f * width);
            T share[kMaxMedia] = {};
            for_shares(
                b.parts, voxels, k.media, density,
                [&](const float* grid) { return read_density<Constant>(grid, at); },
                [&](int i, T s) { share[i] = s; });
            if (k.ordinates != 0) thin_step(k, share, optical, thin);
            // With one emission along it, what leaves a step is exact.
            if (k.emits != 0)
                for (int i = 0; i < k.media; ++i)
                    for (int c = 0; c < 3; ++c)
                        colour[c] = colour[c] + (k.ordinates != 0 ? thin.own[c] : weight) *
                                                    share[i] * k.emission[i][c];
            for (std::int32_t l = 0; l < k.lamps; ++l) {
                const LampParams& lamp = b.lamps[l];
                Vec<T> place;
                const LampSight<T> whole = lamp_over_step(lamp, from, ray.direction, width, place);
                const M<W> lit = dense & (whole.share > 0.0f) & (weight > 0.0f);
                if (!any(lit)) continue;
                const T tau =
                    max_(interpolate(b.optical_depth + l * nodes,
                                     node_corners(node_position(k.nodes, place), k.nodes.size)),
                         T{});
                // Nodes hold one depth: the media here stand for those on the way.
                T left[3] = {exp_(T{} - tau)};
                left[1] = left[2] = left[0];
                for (int c = 0; c < 3 && k.forward != 0; ++c) {
                    T kept{};
                    for (int i = 0; i < k.media; ++i) kept = kept + share[i] * k.kept[i][c];
                    left[c] = exp_(T{} - tau * (1.0f - kept));
                }
                const auto add = [&](const LampSight<T>& sight) {
                    if (k.ordinates != 0) {
                        add_apart(k, b, lamp, place, sight, ray.direction, most, tau, weight, lit,
                                  share, thin, colour);
                        return;
                    }
                    const T light = weight * sight.share * left[0];
                    const T turn = one_minus_cosine(ray.direction, sight.way);
                    if (k.beam_sets > 0) {
                        T kept[3];
                        lamp_beam(k, b, lamp, place, sight, turn, most, tau, weight, kept);
                        for (int c = 0; c < 3; ++c)
                            colour[c] = colour[c] + select(lit, kept[c], T{}) *
                                                        (k.albedo[0][c] * lamp.light[c]);
                    }
                    T more[kMaxOctaves];
                    (void)octave_light(k.octaves, tau, light, weight * sight.share, more);
                    for (int i = 0; i < k.media; ++i) {
                        const T phase = min_(phase_density(k.phase[i], turn), most);
                        T scattered = select(lit, light * share[i] * phase, T{});
                        for (int c = 0; c < 3; ++c) {
                            if (k.forward != 0)
                                scattered = select(
                                    lit, weight * sight.share * left[c] * share[i] * phase, T{});
                            colour[c] = colour[c] + scattered * (k.albedo[i][c] * lamp.light[c]);
                        }
                        for (int c = 0; c < 3; ++c) {
                            absorb_octaves(k.octaves, k.octave_depths, i, c, tau,
                                           weight * sight.share, more);
                            for (int n = 1; n < k.octaves.count; ++n) {
                                const T again = select(
                                    lit,
                                    share[i] *
                                        min_(hg_density(all<T>(k.octave_g[i][n]), turn), most) *
                                        more[n],
                                    T{});
                                colour[c] =
                                    colour[c] + again * (k.octave_source[i][n][c] * lamp.light[c]);
                            }
                        }
                    }
                };
                if (!(lamp.radius > 0.0f)) {
                    add(whole);
                    continue;
                }
                // Phase functions and a spot's falloff differ from place to place.
                LampCone<T> cone = lamp_cone(lamp, place);
                cone.share = whole.share * (1.0f / float(lamp.places));
                for (std::int32_t i = 0; i < lamp.places; ++i) add(lamp_place(lamp, cone, i, T{}));
            }
            seen = seen * exp_(T{} - optical);
            return left_of(k, seen, thin) < k.cut;
        });
}

/// Light of the lamps that surfaces send along rays. `turn`: of the places on spheres.
template <int W>
PILEUS_FN void light_surface(const LampMarchParams& k, const LampMarchBuffers& b,
                             const LampSurface<F<W>>& s, F<W> turn, F<W> (&colour)[3]) {
    using T = F<W>;
    constexpr float kInvPi = 4.0f * kInvFourPi;
    for (std::int32_t l = 0; l < k.lamps; ++l) {
        const LampParams& lamp = b.lamps[l];
        const auto add = [&](const LampSight<T>& sight) {
            const T cosine = max_(dot(s.normal, sight.way), T{});
            M<W> lit = s.met & (cosine * sight.share > 0.0f);
            if (any(lit) && has_meshes(k.solids))
                lit = lit & lnot(behind_solids(k.solids, s.at, sight.way, sight.distance, lit));
            if (!any(lit)) return;
            const T tau = depth_to_lamp(k.medium, s.at, sight, lit);
            const T light = cosine * sight.share;
            T through{}, glint{}, density;
            if (is_painted(k.paint) && any(s.water))
                glint = select(
                    s.water, sight.share * sea_glint(s.facets, s.seen, s.from, sight.way, density),
                    T{});
            for (int c = 0; c < 3; ++c) {
                if (c == 0 || k.surface_rest[c] != k.surface_rest[0])
                    through = exp_(T{} - tau * k.surface_rest[c]);
                colour[c] = colour[c] + select(lit, light * through * (s.albedo[c] * kInvPi), T{}) *
                                            lamp.light[c];
                if (is_painted(k.paint))
                    colour[c] = colour[c] + select(lit, glint * through, T{}) * lamp.light[c];
            }
        };
        if (!(lamp.radius > 0.0f)) {
            add(see_lamp(lamp, s.at));
            continue;
        }
        LampCone<T> cone = lamp_cone(lamp, s.at);
        cone.share = cone.share * (1.0f / float(lamp.places));
        for (std::int32_t i = 0; i < lamp.places; ++i) add(lamp_place(lamp, cone, i, turn));
    }
}

template <int W>
PILEUS_FN void lamp_march_rows(const LampMarchParams& k, const LampMarchBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    constexpr int across = kMarchAcross<W>;
    const I<W> number = iota<I<W>>();
    const std::int64_t pixels = std::int64_t(k.camera.width) * k.camera.height;
    for (std::uint32_t row = begin; row < end; row += W / across)
        for (std::int32_t x = 0; x < k.camera.width; x += across) {
            const std::int32_t y = std::int32_t(row), last = std::int32_t(end);
            const I<W> px = number % across + x, py = number / across + y;
            const M<W> real = (px < k.camera.width) & (py < last);
            const Ray<T> ray = camera_ray(k.camera, to_float(px), to_float(py));
            const Segment<T> box = clip_to_medium(k.medium, ray);
            T opaque = all<T>(3e38f);
            if (b.opaque_depth != nullptr)
                for_block<W>(k.camera, x, y, last, [&](int l, std::int64_t pixel) {
                    set_lane(opaque, l, b.opaque_depth[pixel]);
                });
            const T leave = select(real, min_(box.leave, opaque), box.enter);
            T colour[3] = {}, behind[3] = {};
            if (k.media > 0 && any(box.enter < leave)) {
                if (k.medium.constant != 0)
                    march_lamps<W, true>(k, b, ray, box.enter, leave, colour);
                else
                    march_lamps<W, false>(k, b, ray, box.enter, leave, colour);
            }
            if (b.background != nullptr && (k.ground != 0 || has_meshes(k.solids))) {
                const LampSurface<T> surface = lamp_surface(k, ray, opaque, real);
                T turn{};
                for (int l = 0; l < W && k.spheres != 0; ++l)
                    set_lane(turn, l,
                             turn_of_spiral(std::uint32_t(lane(px, l) + k.camera.left),
                                            std::uint32_t(picture_row(k.camera, lane(py, l)))));
                if (any(surface.met)) light_surface<W>(k, b, surface, turn, behind);
            }
            for_block<W>(k.camera, x, y, last, [&](int l, std::int64_t pixel) {
                for (int c = 0; c < 3; ++c) {
                    b.colour[c * pixels + pixel] += lane(colour[c], l);
                    if (b.background != nullptr)
                        b.background[c * pixels + pixel] += lane(behind[c], l);
                }
            });
        }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
