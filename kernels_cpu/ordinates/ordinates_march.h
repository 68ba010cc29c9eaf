// SPDX-License-Identifier: Apache-2.0
// A march through light of discrete ordinates: what the peak of the phase function keeps on its
// way apart from all else.
// in: a field, sunlight's depth, light on nodes -> out: planes of pixels, counts.
// docs/ordinates.md, "The march"
#pragma once
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/display/beam.h"
#include "kernels_cpu/display/behind.h"
#include "kernels_cpu/ordinates/ordinates_params.h"
#include "kernels_cpu/raymarch/raymarch.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What does not change along a ray.
template <class T>
struct OrdinatesRay {
    T turn, most;                         ///< of the sun: 1 - cos; bound on a phase function
    T apart[kMaxMedia], peak[kMaxMedia];  ///< phase function without and within its peak
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
    const T within = share_in_peak(r.turn, o.turn);
    for (int i = 0; i < kMaxMedia && i < k.media; ++i) {
        const T phase = min_(phase_density(k.phase[i], r.turn), r.most);
        r.peak[i] = phase * within;
        r.apart[i] = phase - r.peak[i];
    }
    r.angle = beam_angle(r.turn);
    // Light travels against the ray.
    if (o.moments > 0) sh_eval<4>(T{} - d.x, T{} - d.y, T{} - d.z, r.harmonic);
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

/// What media scatter towards the camera at a place, each by its share: per unit of optical depth,
/// by channel.
template <class T>
struct OrdinatesSource {
    T rest[3];    ///< of the optical depth: what counts
    T around[3];  ///< light from all around; times `rest`, as the next
    T apart[3];   ///< sunlight, of what is left of it, without the peak of the phase function
    T peak[3];    ///< and within it
    T sun[3];     ///< and times the albedo alone
};

/// The nodes around a place; a field that is no grid has a function of its own.
template <class T, class Field>
PILEUS_FN Corners<T> ordinate_corners(const Field& field, const OrdinatesMarchParams& o,
                                      const Vec<T>& place) {
    const MediumView& m = o.march.medium;
    return node_corners(node_position(o.nodes, field_in_box(field, m, place)), o.nodes.size,
                        m.periodic != 0);
}

/// Numbers of a level or of the one grid, and of all levels.
PILEUS_FN std::int64_t ordinate_level(const OrdinatesMarchParams& o) {
    return std::int64_t(o.nodes.size[0]) * o.nodes.size[1] * o.nodes.size[2];
}
PILEUS_FN std::int64_t ordinate_numbers(const OrdinatesMarchParams& o) {
    return ordinate_level(o) * (o.levels.count > 1 ? o.levels.count : 1);
}

/// The same nodes where moments are.
template <class T>
PILEUS_FN const Corners<T>& moment_corners(const Corners<T>& at) {
    return at;
}

/// How far moments count at a place: nodes around it see the camera in directions of their own,
/// which are one direction where the camera is far.
template <class T>
struct NearCamera {
    T share;
    bool some, all;  ///< of the lanes
};
template <class T>
PILEUS_FN T in_finest(const Corners<T>&, T share) {
    return share;
}
template <class T, class Field, class At>
PILEUS_FN NearCamera<T> near_camera(const OrdinatesMarch<T, Field>& r, const Vec<T>& p,
                                    const At& at) {
    if (r.o.moments == 0) return {T{}, false, false};
    if (!(r.o.per_near > 0.0f)) return {all<T>(1.0f), true, true};
    const float* c = r.k.camera.origin;
    const T x = p.x - c[0], y = p.y - c[1], z = p.z - c[2];
    const T off = sqrt_(x * x + y * y + z * z) * r.o.per_near;
    const T share = in_finest(at, max_(min_(2.0f - off, all<T>(1.0f)), T{}));
    return {share, any(share > 0.0f), !any(share < 1.0f)};
}

/// Light from all around, of one set, that a medium scatters towards the camera.
template <class T, class At>
PILEUS_FN T ordinates_seen(const OrdinatesMarchParams& o, const float* light, const At& at,
                           const NearCamera<T>& near, const T (&degree)[4], std::int32_t s, int i) {
    T far{}, own{};
    if (!near.all) far = max_(interpolate(light, at), T{});
    if (!near.some) return far;
    for (int l = 0; l < 4; ++l) own = own + degree[l] * o.scatter[s][i][l];
    own = max_(own, T{});
    const T mixed = far + (own - far) * near.share;
    return select(near.share >= 1.0f, own, select(near.share > 0.0f, mixed, far));
}

template <class T, class Field, class At>
PILEUS_FN OrdinatesSource<T> ordinates_source(const OrdinatesMarch<T, Field>& r, const At& at,
                                              const Vec<T>& place, T density) {
    const OrdinatesMarchParams& o = r.o;
    const std::int64_t nodes = ordinate_numbers(o);
    const std::int64_t level = ordinate_level(o);
    const NearCamera<T> near = near_camera(r, place, at);
    T degree[kMaxOrdinateSets][4] = {};
    for (std::int32_t s = 0; s < o.sets && near.some; ++s)
        for (int m = 0; m < kOrdinateMoments; ++m)
            degree[s][ordinate_degree(m)] =
                degree[s][ordinate_degree(m)] +
                interpolate(r.n.moments + (s * kOrdinateMoments + m) * level, moment_corners(at)) *
                    r.own.harmonic[m];
    OrdinatesSource<T> out{};
    field_shares(r.field, place, density, [&](int i, T share) {
        T rest[3];
        for (int c = 0; c < 3; ++c) {
            rest[c] = share * o.rest[i][c];
            out.rest[c] = out.rest[c] + rest[c];
            out.apart[c] = out.apart[c] + share * r.own.apart[i] * o.sun[i][c];
            out.peak[c] = out.peak[c] + share * r.own.peak[i] * o.sun[i][c];
            out.sun[c] = out.sun[c] + share * o.sun[i][c];
        }
        for (std::int32_t s = 0; s < o.sets; ++s) {
            const T seen = ordinates_seen(o, r.n.light + (s * r.k.media + i) * nodes, at, near,
                                          degree[s], s, i);
            for (int c = 0; c < 3; ++c)
                out.around[c] = out.around[c] + rest[c] * seen * o.colour[s][c];
        }
    });
    return out;
}

/// Of the optical depth to the sun, what counts: by the media on the way.
template <class T, class Field, class At>
PILEUS_FN void ordinates_sunward(const OrdinatesMarch<T, Field>& r, const At& at, T (&rest)[3]) {
    const OrdinatesMarchParams& o = r.o;
    if (r.n.sunward == nullptr) {
        for (int c = 0; c < 3; ++c) rest[c] = all<T>(o.rest[0][c]);
        return;
    }
    const std::int64_t nodes = ordinate_numbers(o);
    for (int i = 0; i < r.k.media; ++i) {
        const T part = interpolate(r.n.sunward + i * nodes, at);
        for (int c = 0; c < 3; ++c) rest[c] = rest[c] + part * o.rest[i][c];
    }
}

/// A panel from `from` to `to`, with the density and light of its middle.
template <class T, class Field>
PILEUS_FN void add_single(const OrdinatesMarch<T, Field>& r, T from, T to, M_of<T> dense,
                          OrdinatesSum<T>& sum) {
    const OrdinatesMarchParams& o = r.o;
    const T width = to - from, look = from + 0.5f * width;
    const Vec<T> p{r.origin.x + r.direction.x * look, r.origin.y + r.direction.y * look,
                   r.origin.z + r.direction.z * look};
    const T filter = max_(width, pixel_width(r.k.camera, r.k.step, r.shift + look));
    r.counts[kCountSamples] += count_bits(bits_of(dense));
    const T density = select(dense, field_density(r.field, p, filter), T{});
    const T optical = density * (r.k.medium.sigma * width);
    const auto lit = optical > 0.0f;
    if (!any(lit)) return;
    const auto at = ordinate_corners(r.field, o, p);
    const OrdinatesSource<T> source = ordinates_source(r, at, p, density);
    T straight[3] = {}, kept[3] = {};
    if (o.sunlit != 0) {
        T unused[3] = {}, rest[3] = {}, beam[3] = {};
        const T tau = sunlight_at(r.k, r.b.optical_depth, r.field, p, density, lit, r.own.turn,
                                  r.counts, unused);
        beam_light(r.n.beam, o.channels, o.beam_rest, r.own.angle, r.own.most, tau, all<T>(1.0f),
                   beam);
        ordinates_sunward(r, at, rest);
        const T seen = sun_seen(r.k, r.b, p), whole = seen * exp_(T{} - tau);
        T left{};
        for (int c = 0; c < 3; ++c) {
            if (c < o.channels) left = seen * exp_(T{} - tau * rest[c]);
            straight[c] = left * source.apart[c];
            kept[c] = whole * source.peak[c] + seen * beam[c] * source.sun[c];
        }
    }
    const T before = sum.ray.transmittance;
    pass_depth(optical, r.shift + from, r.shift + to, sum.ray);
    const T own = before * one_minus_exp(optical);
    T thin_own{};
    for (int c = 0; c < 3; ++c) {
        if (c < o.channels) {
            const T rest = max_(source.rest[c], all<T>(1e-6f)), thin = optical * rest;
            thin_own = sum.thin[c] * one_minus_exp(thin) / rest;
            sum.thin[c] = sum.thin[c] * exp_(T{} - thin);
        } else {
            sum.thin[c] = sum.thin[0];
        }
        sum.ray.colour[c] =
            sum.ray.colour[c] + own * kept[c] + thin_own * (source.around[c] + straight[c]);
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
template <int W>
PILEUS_FN void add_behind(const OrdinatesMarchParams& o, const OrdinatesMarchBuffers& n,
                          const MarchedBlock<W>& at, OrdinatesSum<F<W>>& sum) {
    using T = F<W>;
    T light[3];
    light_behind(o.behind, at.ray.direction, light);
    const std::int64_t pixels = std::int64_t(o.march.camera.width) * o.march.camera.height;
    const auto pixel = at.y * o.march.camera.width + at.x;
    if (n.surfaces != nullptr && any(at.solid)) {
        T rgb[3];
        for (int c = 0; c < 3; ++c)
            rgb[c] = gather(n.surfaces + c * pixels, select(at.solid, pixel, pixel - pixel));
        auto seen = at.solid;
        if (o.behind.hidden != 0) seen = seen & (rgb[0] + rgb[1] + rgb[2] > 0.0f);
        for (int c = 0; c < 3; ++c) light[c] = select(seen, rgb[c], light[c]);
    }
    for (int c = 0; c < 3; ++c)
        sum.ray.colour[c] =
            sum.ray.colour[c] + max_(sum.thin[c] - sum.ray.transmittance, T{}) * light[c];
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
        add_behind<W>(o, n, at, sum);
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
