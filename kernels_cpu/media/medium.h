// SPDX-License-Identifier: Apache-2.0
// Grids read between their points, and rays clipped to the box.
// in: positions in voxels or metres, box-local -> out: density, grid values, path segments.
// docs/methods.md 1: trilinear between voxel centres, clamped inside the box or wrapped around; or
// constant within voxels.
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/vec.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Place within one period of `length`. What lies 2^22 periods away or farther has no place that a
/// float could tell: it counts as one of the ends.
template <class T>
PILEUS_FN T wrap_place(T at, float length) {
    const T most = all<T>(0x1p22f);
    const T periods = min_(max_(at * (1.0f / length), T{} - most), most);
    return min_(max_(at - to_float(floor_int(periods)) * length, T{}), all<T>(length));
}

/// The eight cells around a position and their weights, of which those of a line outside a grid's
/// outermost centres are below 0 and above 1.
template <class T>
struct Corners {
    I_of<T> x0, x1, y0, y1, z0, z1;  // z and y already multiplied by their strides
    T fx, fy, fz;
};

/// The two cells around a place along an axis of a grid that goes around, and the place between.
template <class T>
PILEUS_FN void split_around(T v, std::int32_t n, I_of<T>& low, I_of<T>& high, T& fraction) {
    using II = I_of<T>;
    const T c = max_(min_(v - 0.5f, all<T>(float(n))), all<T>(-0.5f));
    const II whole = floor_int(c);
    fraction = c - to_float(whole);
    low = select(whole < 0, all<II>(n - 1), select(whole >= n, II{}, whole));
    high = select(low + 1 >= n, II{}, low + 1);
}

/// Cells along each axis by `split`, but along x and y of a grid that `wraps`.
template <class T, class Split>
PILEUS_FN Corners<T> corners_by(const Vec<T>& p, const std::int32_t* size, bool wraps,
                                Split split) {
    Corners<T> c;
    if (wraps) {
        split_around(p.x, size[0], c.x0, c.x1, c.fx);
        split_around(p.y, size[1], c.y0, c.y1, c.fy);
    } else {
        split(p.x, size[0], c.x0, c.x1, c.fx);
        split(p.y, size[1], c.y0, c.y1, c.fy);
    }
    split(p.z, size[2], c.z0, c.z1, c.fz);
    const std::int32_t row = size[0], slice = size[0] * size[1];
    c.y0 = c.y0 * row, c.y1 = c.y1 * row;
    c.z0 = c.z0 * slice, c.z1 = c.z1 * slice;
    return c;
}

/// `p` in units of cells; cell centres lie at i + 1/2. Beyond the outermost centres the last cell
/// counts, or along x and y of a grid that `wraps` the first one of the next period.
template <class T>
PILEUS_FN Corners<T> corners(const Vec<T>& p, const std::int32_t* size, bool wraps = false) {
    using II = I_of<T>;
    return corners_by(p, size, wraps, [](T v, std::int32_t n, II& low, II& high, T& fraction) {
        const T c = max_(min_(v - 0.5f, all<T>(float(n - 1))), T{});
        low = to_int(c);
        fraction = c - to_float(low);
        high = min_(low + 1, all<II>(n - 1));
    });
}

/// The same of nodes whose values go on in a line beyond the outermost centres, up to the faces of
/// the grid: optical depth and light are not level there, and a sharp face of a medium lies there.
template <class T>
PILEUS_FN Corners<T> node_corners(const Vec<T>& p, const std::int32_t* size, bool wraps = false) {
    using II = I_of<T>;
    return corners_by(p, size, wraps, [](T v, std::int32_t n, II& low, II& high, T& fraction) {
        const T at = max_(min_(v - 0.5f, all<T>(float(n) - 0.5f)), all<T>(-0.5f));
        low = min_(max_(floor_int(at), II{}), all<II>(n > 1 ? n - 2 : 0));
        fraction = at - to_float(low);
        high = min_(low + 1, all<II>(n - 1));
    });
}

/// The cell that holds `p` alone.
template <class T>
PILEUS_FN Corners<T> own_cell(const Vec<T>& p, const std::int32_t* size) {
    using II = I_of<T>;
    const auto whole = [](T v, std::int32_t n) {
        return min_(max_(to_int(v), II{}), all<II>(n - 1));
    };
    const std::int32_t row = size[0], slice = size[0] * size[1];
    Corners<T> c{};
    c.x0 = c.x1 = whole(p.x, size[0]);
    c.y0 = c.y1 = whole(p.y, size[1]) * row;
    c.z0 = c.z1 = whole(p.z, size[2]) * slice;
    return c;
}

template <class T>
PILEUS_FN T interpolate(const float* grid, const Corners<T>& c) {
    const auto mix = [](T a, T b, T f) { return a + (b - a) * f; };
    const auto row = [&](I_of<T> yz) {
        return mix(gather(grid, yz + c.x0), gather(grid, yz + c.x1), c.fx);
    };
    const T low = mix(row(c.z0 + c.y0), row(c.z0 + c.y1), c.fy);
    const T high = mix(row(c.z1 + c.y0), row(c.z1 + c.y1), c.fy);
    return mix(low, high, c.fz);
}

/// What a grid of densities holds: of one cell where they are constant within cells.
template <bool Constant, class T>
PILEUS_FN T read_density(const float* grid, const Corners<T>& c) {
    if constexpr (Constant)
        return gather(grid, c.z0 + c.y0 + c.x0);
    else
        return interpolate(grid, c);
}

/// Where a ray enters and leaves the box [0, extent], metres along it; enter >= 0.
template <class T>
struct Segment {
    T enter, leave;
};
/// The same for a layer [0, height] without sides: heights and climbs along z alone.
template <class T>
PILEUS_FN Segment<T> clip_to_layer(T origin, T direction, float height) {
    const T inverse = 1.0f / copysign_(max_(abs_(direction), all<T>(1e-18f)), direction + 0.0f);
    const T a = (T{} - origin) * inverse, b = (height - origin) * inverse;
    return {max_(T{}, min_(a, b)), max_(a, b)};
}
template <class T>
PILEUS_FN Segment<T> clip_to_box(const Vec<T>& o, const Vec<T>& d, const float* extent) {
    T enter{}, leave = all<T>(3.0e38f);
    const auto slab = [&](T origin, T direction, float size) {
        // Adding zero makes one of both zeros: a ray in a face's plane has one answer.
        const T inverse = 1.0f / copysign_(max_(abs_(direction), all<T>(1e-18f)), direction + 0.0f);
        const T a = (T{} - origin) * inverse, b = (size - origin) * inverse;
        enter = max_(enter, min_(a, b));
        leave = min_(leave, max_(a, b));
    };
    slab(o.x, d.x, extent[0]);
    slab(o.y, d.y, extent[1]);
    slab(o.z, d.z, extent[2]);
    return {enter, leave};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
