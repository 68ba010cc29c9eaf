// SPDX-License-Identifier: Apache-2.0
// A camera ray through the voxels of a grid, one after the other.
// in: a ray, a grid -> out: every voxel the ray meets, where it enters and leaves it.
// Amanatides, Woo 1987; plane distances are computed anew at each step, so nothing drifts.
#pragma once
#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/media/medium.h"
#include "src/world/grid/grid.h"

namespace pileus {

/// A voxel on the way; `axis` is across the face of entry (-1: the ray starts inside the box).
struct WalkStep {
    int at[3];
    std::size_t voxel;
    double enter, leave;  ///< metres along the ray
    int axis;
};

/// Calls visit(step) for each voxel from the camera on, until it returns false.
template <class Visit>
void walk_grid(const Grid& grid, const Ray<float>& ray, Visit visit) {
    const double o[3] = {double(ray.origin.x), double(ray.origin.y), double(ray.origin.z)};
    const double d[3] = {double(ray.direction.x), double(ray.direction.y), double(ray.direction.z)};
    WalkStep s{{0, 0, 0}, 0, 0.0, 0.0, -1};
    double last = 3e38;
    for (int a = 0; a < 3; ++a) {
        const double extent = double(grid.cell_m[a]) * grid.size[a];
        if (d[a] == 0.0) {
            if (o[a] < 0.0 || o[a] > extent) return;
            continue;
        }
        const double low = -o[a] / d[a], high = (extent - o[a]) / d[a];
        const double near = low < high ? low : high, far = low < high ? high : low;
        if (near > s.enter) {
            s.enter = near;
            s.axis = a;
        }
        last = far < last ? far : last;
    }
    if (!(s.enter < last)) return;
    for (int a = 0; a < 3; ++a) {
        const double v = (o[a] + d[a] * s.enter) / double(grid.cell_m[a]);
        s.at[a] = v <= 0.0 ? 0 : v >= double(grid.size[a]) ? grid.size[a] - 1 : int(v);
    }
    // Cross the nearest of the three planes ahead; every turn leaves one voxel for good.
    for (;;) {
        int axis = -1;
        s.leave = last;
        for (int a = 0; a < 3; ++a) {
            if (d[a] == 0.0) continue;
            const double t =
                ((s.at[a] + (d[a] > 0.0 ? 1 : 0)) * double(grid.cell_m[a]) - o[a]) / d[a];
            if (axis < 0 || t < s.leave) {
                s.leave = t;
                axis = a;
            }
        }
        if (s.leave < s.enter) s.leave = s.enter;
        s.voxel = voxel_index(grid, s.at[0], s.at[1], s.at[2]);
        if (!visit(s) || axis < 0) return;
        s.at[axis] += d[axis] > 0.0 ? 1 : -1;
        if (s.at[axis] < 0 || s.at[axis] >= grid.size[axis]) return;
        s.enter = s.leave;
        s.axis = axis;
    }
}

}  // namespace pileus
