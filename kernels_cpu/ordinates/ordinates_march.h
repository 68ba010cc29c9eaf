// SPDX-License-Identifier: Apache-2.0
// A march through light of discrete ordinates: what the peak of the phase function keeps on its
// way apart from all else.
// in: a field, sunlight's depth, light on nodes -> out: planes of pixels, counts.
// docs/ordinates.md, "The march"
#pragma once
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/display/beam.h"
#include "kernels_cpu/light/sky_map.h"
#include "kernels_cpu/ordinates/ordinates_params.h"
#include "kernels_cpu/raymarch/raymarch.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What does not change along a ray.
template <class T>
struct OrdinatesRay {
    T turn, apart, peak, most;  ///< of the sun: 1 - cos; phase function without and within its peak
    BeamAngle<T> angle;
    T harmonic[kOrdinateMoments];  ///< of the way to the camera
};
template <class T>
PILEUS_FN OrdinatesRay<T> ordinates_ray(const OrdinatesMarchParams& o, const Vec<T>& d) {
    const RaymarchParams& k = o.march;
    OrdinatesRay<T> r{};
    const Vec<T> to_sun{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    r.turn = one_minus_cosine(to_sun, d);
    r.most = most_density(k.camera, d);
    const T phase = min_(phase_density(k.phase[0], r.turn), r.most);
    r.peak = phase * exp_(T{} - min_(r.turn * (1.0f / o.turn), all<T>(80.0f)));
    r.apart = phase - r.peak;
    r.angle = beam_angle(r.turn);
    // Light travels against the ray.
    if (o.moments > 1) sh_eval<4>(T{} - d.x, T{} - d.y, T{} - d.z, r.harmonic);
    return r;
}

/// One ray on its way.
template <class T, class Field>
struct OrdinatesMarch {
    const OrdinatesMarchParams& o;
    const OrdinatesMarchBuffers& n;
    const RaymarchParams& k;
    const RaymarchBuffers& b;
    const Field& field;
    Vec<T> origin, direction;
    T shift;
    std::int64_t* counts;
    OrdinatesRay<T> own;
};

/// What a ray has gathered; `thin`: what is left of light whose turns within the peak do not count.
template <class T>
struct OrdinatesSum {
    RaySum<T> ray;
    T thin[3];
};

template <class T>
PILEUS_FN T left_of(const OrdinatesSum<T>& sum) {
    return max_(sum.thin[0], max_(sum.thin[1], sum.thin[2]));
}

/// Light that comes from all around, scattered towards the camera.
template <class T, class Field>
PILEUS_FN void gather_ordinates(const OrdinatesMarch<T, Field>& r, const Vec<T>& place,
                                T (&out)[3]) {
    const OrdinatesMarchParams& o = r.o;
    const std::int64_t nodes = std::int64_t(o.nodes.size[0]) * o.nodes.size[1] * o.nodes.size[2];
    const Corners<T> at =
        node_corners(node_position(o.nodes, field_in_box(r.field, r.k.medium, place)), o.nodes.size,
                     r.k.medium.periodic != 0);
    for (std::int32_t s = 0; s < o.sets; ++s) {
        const float* light = r.n.light + s * o.moments * nodes;
        T seen{};
        if (o.moments == 1) {
            seen = interpolate(light, at);
        } else {
            for (int m = 0; m < kOrdinateMoments; ++m)
                seen =
                    seen + interpolate(light + m * nodes, at) * r.own.harmonic[m] * o.scatter[s][m];
        }
        seen = max_(seen, T{});
        for (int c = 0; c < 3; ++c) out[c] = out[c] + seen * o.colour[s][c];
    }
}

/// A panel from `from` to `to`, with the density and light of its middle.
template <class T, class Field>
PILEUS_FN void add_single(const OrdinatesMarch<T, Field>& r, T from, T to, M_of<T> dense,
                          OrdinatesSum<T>& sum) {
    const T width = to - from, look = from + 0.5f * width;
    const Vec<T> p{r.origin.x + r.direction.x * look, r.origin.y + r.direction.y * look,
                   r.origin.z + r.direction.z * look};
    const T filter = max_(width, pixel_width(r.k.camera, r.k.step, r.shift + look));
    r.counts[kCountSamples] += count_bits(bits_of(dense));
    const T density = select(dense, field_density(r.field, p, filter), T{});
    const T optical = density * (r.k.medium.sigma * width);
    const auto lit = optical > 0.0f;
    if (!any(lit)) return;
    T around[3] = {}, straight[3] = {}, kept[3] = {};
    gather_ordinates(r, p, around);
    if (r.o.sunlit != 0) {
        T unused[3] = {};
        const T tau = sunlight_at(r.k, r.b.optical_depth, r.field, p, density, lit, r.own.turn,
                                  r.counts, unused);
        T beam[3] = {};
        beam_light(r.n.beam, r.o.channels, r.o.rest, r.own.angle, r.own.most, tau, all<T>(1.0f),
                   beam);
        const T whole = exp_(T{} - tau) * r.own.peak;
        T left{};
        for (int c = 0; c < 3; ++c) {
            if (c < r.o.channels) left = exp_(T{} - tau * r.o.rest[c]) * r.own.apart;
            straight[c] = left * (r.o.sun[c] / max_(all<T>(r.o.rest[c]), all<T>(1e-6f)));
            kept[c] = (whole + beam[c]) * r.o.sun[c];
        }
    }
    const T before = sum.ray.transmittance;
    pass_depth(optical, r.shift + from, r.shift + to, sum.ray);
    const T own = before * one_minus_exp(optical);
    T thin_own{};
    for (int c = 0; c < 3; ++c) {
        if (c < r.o.channels) {
            const T thin = optical * r.o.rest[c];
            thin_own = sum.thin[c] * one_minus_exp(thin);
            sum.thin[c] = sum.thin[c] * exp_(T{} - thin);
        } else {
            sum.thin[c] = sum.thin[0];
        }
        sum.ray.colour[c] =
            sum.ray.colour[c] + own * kept[c] + thin_own * (around[c] + straight[c]);
    }
}
template <class T, class Field>
PILEUS_FN void add_panel(const OrdinatesMarch<T, Field>&, T, T, M_of<T>, RaySample<T>&,
                         OrdinatesSum<T>&) {}
template <class T, class Field>
PILEUS_FN RaySample<T> sample_at(const OrdinatesMarch<T, Field>&, T, T, M_of<T>) {
    return RaySample<T>{};
}

/// Light of what lies behind that turned within the peak alone, and so goes on as it came.
template <class T>
PILEUS_FN void add_behind(const OrdinatesMarchParams& o, const Vec<T>& d, OrdinatesSum<T>& sum) {
    T sky[3];
    for (int c = 0; c < 3; ++c) sky[c] = all<T>(o.sky[c]);
    if (o.map.columns > 0) {
        const Vec<T> seen = map_radiance(o.map, d);
        sky[0] = seen.x, sky[1] = seen.y, sky[2] = seen.z;
    }
    const auto down = d.z < 0.0f;
    for (int c = 0; c < 3; ++c) {
        const T behind = o.has_ground != 0 ? select(down, all<T>(o.ground[c]), sky[c]) : sky[c];
        sum.ray.colour[c] =
            sum.ray.colour[c] + max_(sum.thin[c] - sum.ray.transmittance, T{}) * behind;
    }
}

template <int W, class Field>
PILEUS_FN void ordinates_pixels(const OrdinatesMarchParams& o, const OrdinatesMarchBuffers& n,
                                const Field& field, std::int32_t x, std::int32_t y,
                                std::int32_t end) {
    using T = F<W>;
    const RaymarchParams& k = o.march;
    const RaymarchBuffers& b = n.march;
    const MarchedBlock<W> at = marched_block<W>(k, b, field, x, y, end);
    OrdinatesSum<T> sum{};
    sum.ray.transmittance = all<T>(1.0f);
    sum.ray.half = all<T>(__builtin_inff());
    for (int c = 0; c < 3; ++c) sum.thin[c] = all<T>(1.0f);
    if (k.step.most > 0 && any(at.box.enter < at.leave)) {
        const Vec<T> d = at.ray.direction;
        const MarchStart<T> from = march_start<W>(k, b, at);
        const OrdinatesMarch<T, Field> r{o,
                                         n,
                                         k,
                                         b,
                                         field,
                                         along(at.ray, from.start),
                                         d,
                                         from.start,
                                         b.counts + std::int64_t(y) * kRaymarchCounts,
                                         ordinates_ray(o, d)};
        march_lattice(r, from.lattice, from.before, at.leave - from.start, sum);
        add_behind(o, d, sum);
    }
    store_pixels<W>(k, b, x, y, end, sum.ray);
}

template <int W, class Field>
PILEUS_FN void ordinates_blocks(const OrdinatesMarchParams& o, const OrdinatesMarchBuffers& n,
                                const Field& field, std::uint32_t begin, std::uint32_t end) {
    constexpr int across = kMarchAcross<W>;
    for (std::uint32_t y = begin; y < end; y += W / across)
        for (std::int32_t x = 0; x < o.march.lattice.width; x += across)
            ordinates_pixels<W>(o, n, field, x, std::int32_t(y), std::int32_t(end));
}

template <int W>
PILEUS_FN void ordinates_rows(const OrdinatesMarchParams& o, const OrdinatesMarchBuffers& n,
                              std::uint32_t begin, std::uint32_t end) {
    if (o.march.medium.constant != 0)
        ordinates_blocks<W>(o, n, grid_field<true>(o.march, n.march), begin, end);
    else
        ordinates_blocks<W>(o, n, grid_field<false>(o.march, n.march), begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
