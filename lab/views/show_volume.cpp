// SPDX-License-Identifier: Apache-2.0
// See show_volume.h.
// in: a walk through the voxels per pixel -> out: pixels; each belongs to one thread.
// alpha = 1 - exp(-extinction length), docs/methods.md 3, each image frame, step 5.
#include "lab/views/show_volume.h"

#include "kernels_cpu/core/math.h"
#include "lab/views/colours.h"
#include "lab/views/show_walk.h"
#include "platform/threads.h"
#include "src/world/grid/grid.h"

namespace pileus {
namespace {

constexpr float kAxisShade[3] = {0.72f, 0.88f, 1.0f};  // faces across x, y, z
constexpr float kEdgeShade = 0.45f;
constexpr double kEdgePixels = 0.8;
constexpr double kThinnest = 1e-3;  // transmittance below which a pixel is full

/// Mean density of a leaf over all of its box.
double mean_density(const Leaf& leaf, const Grid& grid) {
    double volume = 1;
    for (int a = 0; a < 3; ++a) volume *= double(leaf.hi[a] - leaf.lo[a]) * double(grid.cell_m[a]);
    return leaf.mass / volume;
}

/// 0 on an edge of the face that the ray enters, or of the leaf's cut with the middle plane where
/// it enters none; 1 from `width_m` on.
float edge_distance(const Leaf& leaf, const Grid& grid, const Ray<float>& ray, const WalkStep& s,
                    const MiddlePlane& plane, double width_m) {
    const float* const origin[3] = {&ray.origin.x, &ray.origin.y, &ray.origin.z};
    const float* const direction[3] = {&ray.direction.x, &ray.direction.y, &ray.direction.z};
    double nearest = width_m;
    for (int a = 0; a < 3; ++a) {
        if (a == s.axis) continue;
        const double at = double(*origin[a]) + double(*direction[a]) * s.enter;
        const double low = at - leaf.lo[a] * double(grid.cell_m[a]);
        const double high = leaf.hi[a] * double(grid.cell_m[a]) - at;
        double edge = low < high ? low : high;
        // Along the cut a face is farther away, and one that lies in it is not met at all.
        const double slope2 = 1.0 - plane.normal[a] * plane.normal[a];
        if (s.axis < 0) edge = slope2 > 1e-9 ? edge / __builtin_sqrt(slope2) : width_m;
        nearest = edge < nearest ? edge : nearest;
    }
    return nearest > 0.0 ? float(nearest / width_m) : 0.0f;
}

/// Front to back: the light of the boxes met so far and what still shines through.
struct BoxRay {
    Float3 light{0, 0, 0};
    float through = 1;
};

/// A leaf that the ray is in: where it came in, and with what colour.
struct Entered {
    std::int32_t collector = -1;
    double enter = 0, mean = 0;
    Float3 colour{0, 0, 0};
};

void leave_leaf(const Entered& in, double leave, float sigma, BoxRay& ray) {
    if (in.collector < 0) return;
    const float alpha = one_minus_exp(float(double(sigma) * in.mean * (leave - in.enter)));
    for (std::size_t c = 0; c < 3; ++c) ray.light[c] += in.colour[c] * alpha * ray.through;
    ray.through *= 1.0f - alpha;
}

/// Metres along the ray to the middle plane, or a negative number where it lies behind.
double plane_distance(const MiddlePlane& plane, const Ray<float>& ray) {
    const float* const o[3] = {&ray.origin.x, &ray.origin.y, &ray.origin.z};
    const float* const d[3] = {&ray.direction.x, &ray.direction.y, &ray.direction.z};
    double height = plane.offset, slope = 0;
    for (int a = 0; a < 3; ++a) {
        height -= plane.normal[a] * double(*o[a]);
        slope += plane.normal[a] * double(*d[a]);
    }
    return slope > 0 ? height / slope : -1.0;
}

BoxRay trace_boxes(const LeafBoxes& boxes, const Grid& grid, const CameraParams& camera,
                   const Ray<float>& ray) {
    BoxRay out;
    Entered in;
    double last = 0;
    const double pixel = 2.0 * double(camera.half_height) / double(camera.height);
    const MiddlePlane plane = middle_plane(grid, camera);
    const double front = plane_distance(plane, ray);
    walk_grid(grid, ray, [&](WalkStep s) {
        if (s.leave <= front) return true;
        if (s.enter <= front) {
            s.enter = front;
            s.axis = -1;
        }
        const std::int32_t here = boxes.collector_of_voxel[s.voxel];
        last = s.leave;
        if (here == in.collector) return true;
        leave_leaf(in, s.enter, boxes.sigma, out);
        in = {here, s.enter, 0, {}};
        if (here >= 0) {
            const Leaf& leaf = boxes.leaves[std::size_t(boxes.collectors[std::size_t(here)].leaf)];
            in.mean = mean_density(leaf, grid);
            in.colour = map_colour(ColourMap::kHeat, 0.12f + 0.88f * float(in.mean) / boxes.full);
            const double width = kEdgePixels * pixel * (camera.orthographic != 0 ? 1.0 : s.enter);
            const float edge = edge_distance(leaf, grid, ray, s, plane, width);
            const float shade = (s.axis < 0 ? 1.0f : kAxisShade[s.axis]) *
                                (kEdgeShade + (1.0f - kEdgeShade) * edge);
            for (float& c : in.colour) c *= shade;
        }
        return double(out.through) > kThinnest;
    });
    leave_leaf(in, last, boxes.sigma, out);
    return out;
}

template <class Pixel>
void for_pixels(int width, int height, int threads, Pixel pixel) {
    parallel_for(threads, height, [&](std::int64_t y, int) {
        for (int x = 0; x < width; ++x)
            pixel(x, int(y), std::size_t(y) * std::size_t(width) + std::size_t(x));
    });
}

}  // namespace

Status look_through(Span<const float> field, const Grid& grid, const CameraParams& camera,
                    int threads, FieldView& out) {
    const std::uint64_t pixels = std::uint64_t(camera.width) * std::uint64_t(camera.height);
    PILEUS_TRY(out.largest.resize(pixels, "largest values"));
    PILEUS_TRY(out.integral.resize(pixels, "integrals"));
    for_pixels(camera.width, camera.height, threads, [&](int x, int y, std::size_t i) {
        float largest = 0;
        double sum = 0;
        walk_grid(grid, camera_ray(camera, float(x), float(y)), [&](const WalkStep& s) {
            const float value = field[s.voxel];
            if (value > 0.0f) sum += double(value) * (s.leave - s.enter);
            largest = value > largest ? value : largest;
            return true;
        });
        out.largest[i] = largest;
        out.integral[i] = float(sum);
    });
    return Status::ok();
}

MiddlePlane middle_plane(const Grid& grid, const CameraParams& camera) {
    MiddlePlane plane{{0, 0, 0}, 0};
    for (int a = 0; a < 3; ++a) {
        plane.normal[a] = double(camera.forward[a]);
        plane.offset += plane.normal[a] * 0.5 * double(grid.cell_m[a]) * grid.size[a];
    }
    return plane;
}

Status look_at_plane(Span<const float> field, const Grid& grid, const CameraParams& camera,
                     int threads, Buffer<float>& values) {
    const MiddlePlane plane = middle_plane(grid, camera);
    PILEUS_TRY(values.resize(std::uint64_t(camera.width) * std::uint64_t(camera.height), "slice"));
    for_pixels(camera.width, camera.height, threads, [&](int x, int y, std::size_t i) {
        const Ray<float> ray = camera_ray(camera, float(x), float(y));
        const double t = plane_distance(plane, ray);
        if (t < 0) return;
        const float* const o[3] = {&ray.origin.x, &ray.origin.y, &ray.origin.z};
        const float* const d[3] = {&ray.direction.x, &ray.direction.y, &ray.direction.z};
        float at[3];
        for (int a = 0; a < 3; ++a) {
            at[a] = float((double(*o[a]) + double(*d[a]) * t) / double(grid.cell_m[a]));
            if (!(at[a] >= 0.0f && at[a] <= float(grid.size[a]))) return;
        }
        values[i] = density_at(field, grid, at);
    });
    return Status::ok();
}

void paint_veil(Span<const float> integral, float per_unit, const Float3& colour, int threads,
                Canvas& canvas) {
    for_pixels(canvas.width, canvas.height, threads, [&](int, int, std::size_t i) {
        blend_over(canvas.rgb.data() + 3 * i, colour, one_minus_exp(per_unit * integral[i]));
    });
}

void paint_heat(Span<const float> values, float full, int threads, Canvas& canvas) {
    for_pixels(canvas.width, canvas.height, threads, [&](int, int, std::size_t i) {
        if (!(values[i] > 0.0f)) return;
        const Float3 colour = map_colour(ColourMap::kHeat, values[i] / full);
        blend_over(canvas.rgb.data() + 3 * i, colour, 1.0f);
    });
}

void paint_leaf_boxes(const LeafBoxes& boxes, const Grid& grid, const CameraParams& camera,
                      int threads, Canvas& canvas) {
    for_pixels(canvas.width, canvas.height, threads, [&](int x, int y, std::size_t i) {
        const BoxRay ray = trace_boxes(boxes, grid, camera, camera_ray(camera, float(x), float(y)));
        float* pixel = canvas.rgb.data() + 3 * i;
        for (std::size_t c = 0; c < 3; ++c) pixel[c] = ray.light[c] + pixel[c] * ray.through;
    });
}

}  // namespace pileus
