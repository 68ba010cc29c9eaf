// SPDX-License-Identifier: Apache-2.0
// Raymarching: single or forward scattered sunlight, and emission, added up along each pixel's ray.
// in: a field, sunlight on nodes or by marching -> out: planes of pixels, counts.
// Palenik 2016, chapters 3 and 4; docs/raymarch.md. A panel of the integral takes one to three
// steps of the lattice; within it they are alike. Pixels know nothing of one another.
#pragma once
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/raymarch/raymarch_rules.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What is left to be seen by a ray.
template <class T>
PILEUS_FN T left_of(const RaySum<T>& sum) {
    return sum.transmittance;
}

/// The whole ray from `low` to `high` metres behind the lattice's start. `March`: a RayMarch, or
/// what has its field, ways, parameters and functions of panels beside it.
template <class T, class Field, template <class, class> class March, class Sum>
PILEUS_FN void march_lattice(const March<T, Field>& r, const Lattice<T>& lattice, T low, T high,
                             Sum& sum) {
    const bool ends = r.k.rule >= kRuleTrapezoid;
    const float steps = float(rule_steps(r.k.rule));
    T n = to_float(to_int(lattice_step(lattice, low) * (1.0f / steps))) * steps, from = low;
    auto alive = low < high;
    RaySample<T> last{};
    if (ends && any(alive)) last = sample_at(r, from, lattice.first, alive);
    // Bounded: every turn of the loop takes every living lane to a later step.
    while (any(alive)) {
        T to = max_(min_(lattice_place(lattice, n + steps), high), from);
        auto cut = alive & lnot(alive);  // panels that end before the lattice's do
        if constexpr (Field::kHasVoxels) {
            // A panel ends where its density does, too: what is left of it comes next.
            if (r.k.rule == kRuleClosed) {
                const T whole = to;
                const Vec<T> start{r.origin.x + r.direction.x * from,
                                   r.origin.y + r.direction.y * from,
                                   r.origin.z + r.direction.z * from};
                const T least = least_way(lattice_place(lattice, n + steps) - from, high);
                to = min_(to, from + field_voxel(r.field, start, r.direction, least));
                cut = alive & (to < whole);
            }
        }
        const T width = to - from;
        // A panel of one sample is empty where that is; others over all of their length.
        const T look = r.k.rule == kRuleClosed ? from + 0.5f * width : from;
        const Vec<T> p{r.origin.x + r.direction.x * look, r.origin.y + r.direction.y * look,
                       r.origin.z + r.direction.z * look};
        // A little wider: the filter may widen before the block ends.
        const T filter = max_(width, pixel_width(r.k.camera, r.k.step, r.shift + to));
        const Block<T> ahead =
            field_ahead(r.field, p, r.direction, filter * (1.25f + 8.0f * lattice.excess));
        auto empty = ahead.bound <= 0.0f;
        if (ends) empty = empty & (width <= ahead.rest);
        const auto dense = alive & lnot(empty);
        if (any(dense)) {
            if (ends)
                add_panel(r, from, to, dense, last, sum);
            else
                add_single(r, from, to, dense, sum);
        }
        T next = Field::kHasVoxels ? select(cut, n, n + steps) : n + steps;
        if (any(alive & empty)) {
            // The last panel that ends within the empty block; it adds nothing either.
            const T whole = to_float(to_int(
                min_(lattice_step(lattice, look + ahead.rest) * (1.0f / steps), all<T>(1e6f))));
            next = select(empty, max_(whole * steps, next), next);
        }
        const T before = n;
        n = next;
        from = max_(lattice_place(lattice, n), low);
        if constexpr (Field::kHasVoxels) {
            cut = cut & lnot(before < n) & (width > 0.0f);
            from = select(cut, to, from);
        }
        alive = alive & (from < high) & (to < high) & (left_of(sum) >= r.k.cut);
        // Whole numbers end at 2^24: a ray that needs more steps is cut short.
        const auto stuck = alive & lnot(before < n) & lnot(cut);
        if (any(stuck)) r.counts[kCountCut] += count_bits(bits_of(stuck));
        alive = alive & lnot(stuck);
    }
}

/// How far before the medium the lattices of a block's rays begin, m.
template <int W>
PILEUS_FN F<W> start_before(const RaymarchParams& k, const RaymarchBuffers& b, I<W> column,
                            I<W> row, const Vec<F<W>>& enters, const Vec<F<W>>& d,
                            const Lattice<F<W>>& lattice) {
    using T = F<W>;
    T before{};
    if (k.step.grid_m > 0) {
        // Planes that stay where they are while the camera moves.
        const float* f = k.camera.forward;
        const T depth = enters.x * f[0] + enters.y * f[1] + enters.z * f[2];
        const T ahead = max_(d.x * f[0] + d.y * f[1] + d.z * f[2], all<T>(1e-3f));
        const T planes =
            max_(min_(depth * (1.0f / k.step.grid_m), all<T>(0x1p30f)), all<T>(-0x1p30f));
        before = max_(depth - to_float(floor_int(planes)) * k.step.grid_m, T{}) / ahead;
    }
    if (k.step.jitter == kJitterNone) return before;
    T u{};
    if (k.step.jitter == kJitterHash) {
        const auto pixel = reinterpret<U<W>>(picture_row(k.camera, row) * whole_width(k.camera) +
                                             (column + k.camera.left));
        u = uniform(threefry(k.step.key[0], k.step.key[1], pixel, U<W>{}).a);
    } else {
        const I<W> x = (column + (k.camera.left + std::int32_t(k.step.key[0]))) & (kNoiseTile - 1);
        const I<W> y =
            (picture_row(k.camera, row) + std::int32_t(k.step.key[1])) & (kNoiseTile - 1);
        u = gather(b.noise, y * kNoiseTile + x);
    }
    const T panel = lattice_place(lattice, all<T>(float(rule_steps(k.rule))));
    return before + u * (k.step.jitter_share * panel);
}

/// Stores the pixels of a block.
template <int W>
PILEUS_FN void store_pixels(const RaymarchParams& k, const RaymarchBuffers& b, std::int32_t x,
                            std::int32_t y, std::int32_t end, const RaySum<F<W>>& sum) {
    const std::int64_t pixels = std::int64_t(k.lattice.width) * k.lattice.height;
    for_block<W>(k.lattice, x, y, end, [&](int l, std::int64_t pixel) {
        b.transmittance[pixel] = lane(sum.transmittance, l);
        if (b.half_depth != nullptr) b.half_depth[pixel] = lane(sum.half, l);
        if (b.ray_depth != nullptr) b.ray_depth[pixel] = lane(sum.depth, l);
        for (int c = 0; c < 3; ++c) b.colour[c * pixels + pixel] = lane(sum.colour[c], l);
    });
}

/// Rays of W pixels, a block from a column and a row on.
template <int W>
struct MarchedBlock {
    I<W> x, y;  ///< pixels of the picture
    Ray<F<W>> ray;
    Segment<F<W>> box;
    F<W> leave;  ///< where the march ends: behind the box, at what is opaque, or at once
    M<W> solid;  ///< whether something opaque is in the pixel at all
};
template <int W, class Field>
PILEUS_FN MarchedBlock<W> marched_block(const RaymarchParams& k, const RaymarchBuffers& b,
                                        const Field& field, std::int32_t x, std::int32_t y,
                                        std::int32_t end) {
    using T = F<W>;
    const I<W> number = iota<I<W>>();
    const I<W> column = number % kMarchAcross<W> + x, row = number / kMarchAcross<W> + y;
    const M<W> real = (column < k.lattice.width) & (row < end);
    MarchedBlock<W> a;
    a.x = column * k.lattice.every + k.lattice.first[0];
    a.y = row * k.lattice.every + k.lattice.first[1];
    a.ray = camera_ray(k.camera, to_float(a.x), to_float(a.y));
    a.box = field_clip(field, a.ray);
    a.leave = a.box.leave;
    a.solid = column < 0;
    if (b.opaque_depth != nullptr) {
        T opaque{};
        for_block<W>(k.lattice, x, y, end, [&](int l, std::int64_t pixel) {
            set_lane(opaque, l, b.opaque_depth[pixel]);
        });
        a.leave = min_(a.leave, opaque);
        a.solid = real & (opaque < __builtin_inff());
    }
    a.leave = select(real, a.leave, a.box.enter);
    return a;
}

/// Where a ray's march begins: its lattice, m from the camera to the lattice's start, and from
/// there to the medium.
template <class T>
struct MarchStart {
    Lattice<T> lattice;
    T start, before;
};
template <int W>
PILEUS_FN MarchStart<F<W>> march_start(const RaymarchParams& k, const RaymarchBuffers& b,
                                       const MarchedBlock<W>& at) {
    using T = F<W>;
    MarchStart<T> s;
    // The lattice knows nothing of what stands behind, unless it should (4.1).
    const T length = max_((k.step.stretch != 0 ? at.leave : at.box.leave) - at.box.enter, T{});
    s.lattice = make_lattice(k.step, at.box.enter, length);
    s.before =
        start_before<W>(k, b, at.x, at.y, along(at.ray, at.box.enter), at.ray.direction, s.lattice);
    s.start = at.box.enter - s.before;
    return s;
}

/// W marched pixels, a block from column x and row y on, in rows before `end`.
template <int W, class Field>
PILEUS_FN void raymarch_pixels(const RaymarchParams& k, const RaymarchBuffers& b,
                               const Field& field, std::int32_t x, std::int32_t y,
                               std::int32_t end) {
    using T = F<W>;
    const MarchedBlock<W> at = marched_block<W>(k, b, field, x, y, end);
    RaySum<T> sum{};
    sum.transmittance = all<T>(1.0f);
    sum.half = all<T>(__builtin_inff());
    if (k.step.most > 0 && any(at.box.enter < at.leave)) {
        const Vec<T>& d = at.ray.direction;
        const MarchStart<T> from = march_start<W>(k, b, at);
        const RayMarch<T, Field> r{
            k, b,          field,           along(at.ray, from.start),
            d, from.start, ray_light(k, d), b.counts + std::int64_t(y) * kRaymarchCounts};
        march_lattice(r, from.lattice, from.before, at.leave - from.start, sum);
        // The light without phase functions is a mean of what is at most 1 (chapter 4.2).
        const auto breach = sum.share > 1.0001f;
        r.counts[kCountBreaches] += count_bits(bits_of(breach));
        const T most = select(breach, 1.0f / max_(sum.share, all<T>(1.0f)), all<T>(1.0f));
        for (int c = 0; c < 3; ++c) sum.colour[c] = sum.colour[c] * most;
    }
    store_pixels<W>(k, b, x, y, end, sum);
}

template <int W, class Field>
PILEUS_FN void raymarch_blocks(const RaymarchParams& k, const RaymarchBuffers& b,
                               const Field& field, std::uint32_t begin, std::uint32_t end) {
    constexpr int across = kMarchAcross<W>;
    for (std::uint32_t y = begin; y < end; y += W / across)
        for (std::int32_t x = 0; x < k.lattice.width; x += across)
            raymarch_pixels<W>(k, b, field, x, std::int32_t(y), std::int32_t(end));
}

template <bool Constant>
PILEUS_FN GridField<Constant> grid_field(const RaymarchParams& k, const RaymarchBuffers& b) {
    return {&k.medium, k.level, k.levels, b.parts, k.media};
}

template <int W>
PILEUS_FN void raymarch_rows(const RaymarchParams& k, const RaymarchBuffers& b, std::uint32_t begin,
                             std::uint32_t end) {
    if (k.medium.constant != 0)
        raymarch_blocks<W>(k, b, grid_field<true>(k, b), begin, end);
    else
        raymarch_blocks<W>(k, b, grid_field<false>(k, b), begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
