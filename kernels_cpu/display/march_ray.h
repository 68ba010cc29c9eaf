// SPDX-License-Identifier: Apache-2.0
// A ray through the density grid in steps that leap over empty blocks; the sun's depth per node.
// in: density, majorants, rays -> out: visits of steps; optical depths.
// docs/methods.md 4. Samples sit on a lattice along each ray; skipping leaves out zeros only.
// Through a periodic medium rays run on unbent; what they read is reduced to one period.
#pragma once
#include "kernels_cpu/display/density_pairs.h"
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/media/detail.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN Vec<T> along(const Ray<T>& r, T t) {
    return {r.origin.x + r.direction.x * t, r.origin.y + r.direction.y * t,
            r.origin.z + r.direction.z * t};
}

/// Bound on the density around `p` (voxels), and metres from there to the end of its block, or of
/// the cube of empty blocks around it. Where all blocks hold medium nobody leaps: `rest` is 0.
template <class T>
struct Block {
    T bound, rest;
};
template <class T>
PILEUS_FN Block<T> block_ahead(const MediumView& m, const Vec<T>& p, const Vec<T>& d) {
    using II = I_of<T>;
    const auto index = [&](T v, int axis) {
        return min_(max_(to_int(v * (1.0f / m.block)), II{}), all<II>(m.blocks[axis] - 1));
    };
    const II x = index(p.x, 0), y = index(p.y, 1), z = index(p.z, 2);
    const T bound = gather(m.majorant, z * (m.blocks[1] * m.blocks[0]) + (y * m.blocks[0] + x));
    if (!any(bound <= 0.0f)) return {bound, T{}};
    const T free = max_(T{} - bound, T{});
    const auto rest = [&](II i, T v, T direction, int axis) {
        const auto forward = direction >= 0.0f;
        const T block = to_float(i) + select(forward, free + 1.0f, T{} - free);
        // The grid may end within its last block; behind it the next period's begins.
        const T face = min_(max_(block * m.block, T{}), all<T>(float(m.size[axis])));
        const T per_voxel = m.cell[axis] / max_(abs_(direction), all<T>(1e-18f));
        return select(forward, face - v, v - face) * per_voxel;
    };
    const T t = min_(min_(rest(x, p.x, d.x, 0), rest(y, p.y, d.y, 1)), rest(z, p.z, d.z, 2));
    return {bound, max_(t, T{})};
}

/// The cells that are read for the density at `p`, voxels.
template <bool Constant, class T>
PILEUS_FN Corners<T> density_corners(const MediumView& m, const Vec<T>& p) {
    if constexpr (Constant)
        return own_cell(p, m.size);
    else
        return corners(p, m.size, m.periodic != 0);
}

/// Metres along `d` from `p`, voxels, to the end of its voxel. Rounding may put a place just before
/// the face that it stands on: the voxel `least` metres farther on counts, and never less is left.
template <class T>
PILEUS_FN T voxel_ahead(const MediumView& m, const Vec<T>& p, const Vec<T>& d, T least) {
    const auto rest = [&](T v, T direction, int axis) {
        const T per_voxel = m.cell[axis] / max_(abs_(direction), all<T>(1e-18f));
        const T whole = to_float(floor_int(v + direction * least * (1.0f / m.cell[axis])));
        return select(direction >= 0.0f, whole + 1.0f - v, v - whole) * per_voxel;
    };
    return max_(min_(min_(rest(p.x, d.x, 0), rest(p.y, d.y, 1)), rest(p.z, d.z, 2)), least);
}

/// Least way that a march through constant voxels takes, where it takes steps of `step` over
/// `length` metres: more than rounding takes from a place, and nothing beside a voxel.
template <class T>
PILEUS_FN T least_way(T step, T length) {
    return max_(step * 0x1p-9f, length * 0x1p-22f);
}

/// Shortest step as a share of the ray in the box: grids have at most 4096 cells along an axis, so
/// that a ray still takes two steps or more in each cell it crosses.
constexpr float kMinStep = 0x1p-13f;

/// Most steps of a ray through a periodic medium: a level ray would see no end of it.
constexpr float kMaxPeriodicSteps = 0x1p17f;

/// Where a ray enters and leaves the medium's box, or the layer that a periodic one is.
template <class T>
PILEUS_FN Segment<T> clip_to_medium(const MediumView& m, const Ray<T>& ray) {
    if (m.periodic == 0) return clip_to_box(ray.origin, ray.direction, m.extent);
    Segment<T> s = clip_to_layer(ray.origin.z, ray.direction.z, m.extent[2]);
    s.leave = min_(s.leave, s.enter + kMaxPeriodicSteps * m.step);
    return s;
}

/// Metres within the box, or within the period that holds them.
template <class T>
PILEUS_FN Vec<T> reduced(const MediumView& m, const Vec<T>& q) {
    if (m.periodic == 0) return q;
    return {wrap_place(q.x, m.extent[0]), wrap_place(q.y, m.extent[1]), q.z};
}

template <class T>
PILEUS_FN Vec<T> in_voxels(const MediumView& m, const Vec<T>& q) {
    return {q.x * (1.0f / m.cell[0]), q.y * (1.0f / m.cell[1]), q.z * (1.0f / m.cell[2])};
}

/// How a march goes on, which its samples may change for the next step.
template <class T>
struct Pace {
    T stride = all<T>(1.0f);  ///< steps to take at once: 1, 2, 4 ...
    M_of<T> inside{};         ///< there was medium: no block is asked whether there is some ahead
};

/// Visits the middles of steps that start at enter + n step; the last one ends at `leave`. Through
/// constant voxels a step ends at the voxel's face, too, so that sums of densities are exact.
/// `sample(dense, t, width, voxel position, metres)`, both places within one period, may return
/// lanes that are finished. Every lane goes its own way, whatever the others do.
template <bool Constant, class T, class Sample>
PILEUS_FN void march_ray(const MediumView& m, const Ray<T>& ray, T enter, T leave,
                         const Pace<T>& pace, Sample sample) {
    T n{};  // steps; through constant voxels metres
    auto alive = enter < leave;
    // A flat voxel sets the step for rays along it, too: bound their number (docs/testing.md S41).
    const float least = m.periodic != 0 ? 1.0f / kMaxPeriodicSteps : kMinStep;
    const T step = max_(all<T>(m.step), (leave - enter) * least), per_metre = 1.0f / step;
    // Bounded: every turn of the loop advances every living lane by a step.
    while (any(alive)) {
        const T start = Constant ? enter + n : enter + n * step;
        T width = max_(min_(step * pace.stride, leave - start), T{});
        if constexpr (Constant) {
            const Vec<T> from = in_voxels(m, reduced(m, along(ray, start)));
            const T shortest = least_way(step, leave - enter);
            width = min_(width, voxel_ahead(m, from, ray.direction, shortest));
        }
        T ahead = Constant ? width : pace.stride;
        const T t = start + 0.5f * width;
        const Vec<T> q = reduced(m, along(ray, t));
        const Vec<T> p = in_voxels(m, q);
        auto dense = alive;
        if (any(alive & lnot(pace.inside))) {
            const Block<T> block = block_ahead(m, p, ray.direction);
            dense = alive & (pace.inside | (block.bound > 0.0f));
            // An empty block ends at the face of a voxel. Else jump to the last step whose middle
            // lies in empty blocks; it adds nothing either.
            const T leap = Constant
                               ? max_(0.5f * width + block.rest, width)
                               : max_(to_float(to_int(min_(block.rest * per_metre, all<T>(1e6f)))),
                                      all<T>(1.0f));
            ahead = select(dense, ahead, leap);
        }
        const auto ended = sample(dense, t, width, p, q);
        n = n + ahead;
        alive = alive & lnot(dense & ended) & ((Constant ? enter + n : enter + n * step) < leave);
    }
}

/// Integral of the density between two distances, as long as light is left.
template <bool Constant, bool Detail = false, class T>
PILEUS_FN T density_along(const MediumView& m, const Ray<T>& ray, T enter, T leave) {
    T sum{};
    Pace<T> pace;
    march_ray<Constant>(m, ray, enter, leave, pace,
                        [&](M_of<T> dense, T, T width, const Vec<T>& p, const Vec<T>& metres) {
                            if (any(dense)) {
                                const Corners<T> at = density_corners<Constant>(m, p);
                                T density = density_at<Constant>(m, at);
                                if constexpr (Detail)
                                    density = with_detail(*m.detail, metres, density);
                                sum = select(dense, sum + width * density, sum);
                                pace.inside = dense & (density > 0.0f);
                            }
                            return sum * m.sigma > 60.0f;  // e^-60 is nothing
                        });
    return sum;
}

/// Optical depth from `origin` along `direction` to the end of the box.
template <bool Detail = false, class T>
PILEUS_FN T optical_depth(const MediumView& m, const Ray<T>& ray, M_of<T> wanted) {
    const Segment<T> box = clip_to_medium(m, ray);
    const T leave = select(wanted, box.leave, box.enter);
    if constexpr (Detail) return density_along<false, true>(m, ray, box.enter, leave) * m.sigma;
    if (m.constant != 0) return density_along<true>(m, ray, box.enter, leave) * m.sigma;
    return density_along<false>(m, ray, box.enter, leave) * m.sigma;
}

/// Rows of nodes [begin, end), a row along x.
template <int W, bool Detail = false>
PILEUS_FN void shadow_rows(const ShadowParams& k, const ShadowBuffers& b, std::uint32_t begin,
                           std::uint32_t end) {
    using T = F<W>;
    const std::int32_t nx = k.nodes.size[0], ny = k.nodes.size[1];
    const Vec<T> d{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    for (std::uint32_t row = begin; row < end; ++row) {
        const float y = (float(std::int32_t(row) % ny) + 0.5f) / k.nodes.per_metre[1] + k.origin[1];
        const float z = (float(std::int32_t(row) / ny) + 0.5f) / k.nodes.per_metre[2] + k.origin[2];
        const NodeRange own = b.rows != nullptr ? b.rows[row] : NodeRange{0, nx};
        for (std::int32_t x = own.first; x < own.last; x += W) {
            const I<W> i = iota<I<W>>() + x;
            const T px = (to_float(i) + 0.5f) / k.nodes.per_metre[0] + k.origin[0];
            const Ray<T> ray{{px, all<T>(y), all<T>(z)}, d};
            const T tau = optical_depth<Detail>(k.medium, ray, i < own.last);
            for (int l = 0; l < W && x + l < own.last; ++l)
                b.optical_depth[std::int64_t(row) * nx + x + l] = lane(tau, l);
        }
    }
}

template <class T>
PILEUS_FN Vec<T> node_position(const NodeGrid& g, const Vec<T>& metres) {
    return {metres.x * g.per_metre[0], metres.y * g.per_metre[1], metres.z * g.per_metre[2]};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
