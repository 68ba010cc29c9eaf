// SPDX-License-Identifier: Apache-2.0
// Light by discrete ordinates as paths read it: what a vertex is worth, and what comes from where.
// in: places, directions -> out: expected light; its exact integral over the phase function.
// docs/importance.md, "Light that is expected"
#pragma once
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/display/beam.h"
#include "kernels_cpu/media/optics.h"
#include "kernels_cpu/media/phase_table.h"
#include "kernels_cpu/path/importance_params.h"
#include "kernels_cpu/path/path_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// One of the nodes around `p`, voxels, drawn with its trilinear weight by the bits of a word.
template <class T, class UU>
PILEUS_FN auto draw_node(const NodeGrid& nodes, const TrackGrid& k, const Vec<T>& p, UU bits) {
    using II = I_of<T>;
    const auto draw = [&](T voxels, int a, UU word, float step, bool wraps) {
        const T jitter = to_float(reinterpret<II>(word)) * step + (0.5f * step - 0.5f);
        const II i = floor_int(voxels * (k.cell[a] * nodes.per_metre[a]) + jitter);
        const std::int32_t n = nodes.size[a];
        const II low = wraps ? all<II>(n - 1) : II{}, high = wraps ? II{} : all<II>(n - 1);
        return select(i < 0, low, select(i >= n, high, i));
    };
    const bool wraps = k.periodic != 0;
    const II x = draw(p.x, 0, bits & 0x7ffu, 0x1p-11f, wraps);
    const II y = draw(p.y, 1, (bits >> 11) & 0x7ffu, 0x1p-11f, wraps);
    const II z = draw(p.z, 2, (bits >> 22), 0x1p-10f, false);
    return (z * nodes.size[1] + y) * nodes.size[0] + x;
}

/// The two numbers that a word holds: upper halves of floats.
template <class II>
PILEUS_FN auto upper_of(II word) {
    return reinterpret<F_of<II>>(word & std::int32_t(0xffff0000u));
}
template <class II>
PILEUS_FN auto lower_of(II word) {
    using T = F_of<II>;
    return reinterpret<T>(reinterpret<U_of<T>>(word) << 16);
}

/// Where the sun's optical depth at `p`, voxels, is read.
template <class T>
PILEUS_FN Corners<T> sun_depth_corners(const ImportanceParams& k, const TrackGrid& grid,
                                       const Vec<T>& p) {
    const NodeGrid& n = k.depth_nodes;
    const Vec<T> at{p.x * (grid.cell[0] * n.per_metre[0]), p.y * (grid.cell[1] * n.per_metre[1]),
                    p.z * (grid.cell[2] * n.per_metre[2])};
    return node_corners(at, n.size, grid.periodic != 0);
}
template <class T>
PILEUS_FN T sun_depth_at(const ImportanceParams& k, const TrackGrid& grid, const Vec<T>& p) {
    const Corners<T> c = sun_depth_corners(k, grid, p);
    const auto mix = [](T a, T b, T f) { return a + (b - a) * f; };
    const auto row = [&](I_of<T> yz) {
        const I_of<T> both = gather(k.sun_depth, yz + c.x0);
        return mix(upper_of(both), lower_of(both), c.fx);
    };
    const T low = mix(row(c.z0 + c.y0), row(c.z0 + c.y1), c.fy);
    const T high = mix(row(c.z1 + c.y0), row(c.z1 + c.y1), c.fy);
    return max_(mix(low, high, c.fz), T{});
}

/// Ask for the memory of what a vertex in the lanes of `m` will read.
template <class T>
PILEUS_FN void ask_for_light(const ImportanceParams& k, const TrackGrid& grid, const Vec<T>& p,
                             M_of<T> m) {
    const auto own = [&](const NodeGrid& n) {
        const Vec<T> at{p.x * (grid.cell[0] * n.per_metre[0]),
                        p.y * (grid.cell[1] * n.per_metre[1]),
                        p.z * (grid.cell[2] * n.per_metre[2])};
        const Corners<T> c = own_cell(at, n.size);
        return c.z0 + c.y0 + c.x0;
    };
    const I_of<T> node = own(k.nodes);
    for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1)
        prefetch_(k.moments + lane(node, lowest_bit(lanes)) * kImportanceMoments);
    if (k.sun_depth == nullptr) return;
    const Corners<T> c = sun_depth_corners(k, grid, p);
    for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const std::int32_t* const from = k.sun_depth + lane(c.x0, i);
        prefetch_(from + lane(c.z0, i) + lane(c.y0, i));
        prefetch_(from + lane(c.z0, i) + lane(c.y1, i));
        prefetch_(from + lane(c.z1, i) + lane(c.y0, i));
        prefetch_(from + lane(c.z1, i) + lane(c.y1, i));
    }
}

/// Light of a place, as long as a vertex there is looked after.
template <class T>
struct LightThere {
    I_of<T> moment[kImportanceMoments];
    T lobe[kImportanceLobes];
};
/// Of nodes and the sun's optical depths; lanes without one read the first.
template <class T>
PILEUS_FN LightThere<T> light_there(const ImportanceParams& k, I_of<T> node, T tau) {
    using II = I_of<T>;
    LightThere<T> out{};
    for (int i = 0; i < kImportanceMoments; ++i)
        out.moment[i] = gather(k.moments, node * kImportanceMoments + i);
    if (k.sun_depth == nullptr) return out;
    const II depth = min_(to_int(tau / (tau + kBeamDepth) * float(kImportanceDepths)),
                          all<II>(kImportanceDepths - 1));
    for (int n = 0; n < kImportanceLobes; ++n)
        out.lobe[n] = gather(k.lobes, depth * kImportanceLobes + n);
    return out;
}

/// Smooth light from a direction, of an irradiance and of a radiance of 1: by degree, so that a
/// phase function turns it by its moments.
template <class T>
struct SmoothLight {
    T sun[4], sky[4];
};
template <class T>
PILEUS_FN SmoothLight<T> smooth_light(const ImportanceParams& k, const LightThere<T>& there,
                                      const Vec<T>& d) {
    SmoothLight<T> out{};
    T harmonic[kImportanceMoments];
    sh_eval<4>(d.x, d.y, d.z, harmonic);
    int i = 0;
#pragma GCC unroll 4
    for (int l = 0; l < 4; ++l) {
        const int first = i;
#pragma GCC unroll 8
        for (; i < (l + 1) * (l + 1); ++i)
            out.sun[l] = out.sun[l] + upper_of(there.moment[i]) * harmonic[i];
        if (k.sets == 1) continue;
        i = first;
#pragma GCC unroll 8
        for (; i < (l + 1) * (l + 1); ++i)
            out.sky[l] = out.sky[l] + lower_of(there.moment[i]) * harmonic[i];
    }
    return out;
}
/// As it comes, and turned by the phase function.
template <class T>
PILEUS_FN T plain(const T (&degree)[4]) {
    return ((degree[0] + degree[1]) + degree[2]) + degree[3];
}
template <class T>
PILEUS_FN T turned_by(const ImportanceParams& k, const T (&degree)[4]) {
    return ((degree[0] + degree[1] * k.moment[1]) + degree[2] * k.moment[2]) +
           degree[3] * k.moment[3];
}

/// Light of an irradiance of 1 that turns within the peak alone have spread about the sun, `turn`
/// (1 - cos) from it, by lobes of the mean cosines `g`.
template <class T>
PILEUS_FN T lobe_light(const LightThere<T>& there, const float (&g)[kImportanceLobes], T turn) {
    T sum{};
#pragma GCC unroll 3
    for (int n = 0; n < kImportanceLobes; ++n)
        sum = sum + there.lobe[n] * hg_density(all<T>(g[n]), turn);
    return sum;
}

/// Light of the sun that turns within the peak alone have led to an angle, over what is left of the
/// beam: of the nearest angle that the tables of beam.h have. Who only expects it may round.
template <class T>
PILEUS_FN T peak_light(const ImportanceParams& k, T turn, T tau) {
    using II = I_of<T>;
    const T x = max_(min_(turn, all<T>(2.0f)), T{});
    const II angle = to_int(even_at_ends(x) * float(kBeamAngles) + 0.5f);
    const T at = tau / (tau + kBeamDepth) * float(kBeamDepths);
    const II depth = min_(to_int(at), all<II>(kBeamDepths - 1));
    const II node = angle * (kBeamDepths + 1) + depth;
    const T near = gather(k.beam, node), far = gather(k.beam, node + 1);
    return near + (at - to_float(depth)) * (far - near);
}

/// What a vertex sends back along the ray that came to it, of an irradiance and of a radiance of 1,
/// before absorption.
template <class T>
struct Expected {
    T sun, sky;                // all of it
    T sun_around, sky_around;  // integral of light_around times the phase function
    T phase, straight;         // density towards the sun, 1/sr; transmittance that is expected
};
template <class T>
PILEUS_FN Expected<T> expected_light(const PathParams& p, const ImportanceParams& k,
                                     const LightThere<T>& there, T tau, const Vec<T>& d) {
    Expected<T> out{};
    const SmoothLight<T> light = smooth_light(k, there, d);
    if (k.sun_depth != nullptr) {
        const Vec<T> sun{all<T>(p.to_sun[0]), all<T>(p.to_sun[1]), all<T>(p.to_sun[2])};
        const T turn = one_minus_cosine(d, sun), smooth = turned_by(k, light.sun);
        out.phase = phase_density(p.optics[0].phase, turn);
        out.straight = exp_(T{} - tau);
        out.sun_around = smooth + lobe_light(there, k.turned_g, turn);
        const T peak = out.phase * share_in_peak(turn, k.peak_turn);
        const T left = exp_(T{} - tau * k.rest);
        const T beam = peak_light(k, turn, tau) * left;
        out.sun = max_(smooth, T{}) + (out.phase - peak) * left + peak * out.straight + beam;
    }
    if (k.sets > 1) {
        out.sky_around = turned_by(k, light.sky);
        out.sky = max_(out.sky_around, T{});
    }
    return out;
}

/// Light that comes from `d`, but for what comes straight from the sun.
template <class T>
struct Around {
    T sun, sky;
};
template <class T>
PILEUS_FN Around<T> light_around(const PathParams& p, const ImportanceParams& k,
                                 const LightThere<T>& there, const Vec<T>& d) {
    Around<T> out{};
    const SmoothLight<T> light = smooth_light(k, there, d);
    if (k.sun_depth != nullptr) {
        const Vec<T> sun{all<T>(p.to_sun[0]), all<T>(p.to_sun[1]), all<T>(p.to_sun[2])};
        out.sun = plain(light.sun) + lobe_light(there, k.lobe_g, one_minus_cosine(d, sun));
    }
    if (k.sets > 1) out.sky = plain(light.sky);
    return out;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
