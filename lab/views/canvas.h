// SPDX-License-Identifier: Apache-2.0
// A small software rasteriser: discs and lines over a picture, smooth edges by coverage.
// in: marks in camera space, farthest first -> out: R G B per pixel, the same for any threads.
// Porter, Duff 1984 ("over"); coverage of a disc or line: a ramp one pixel wide across its edge.
#pragma once
#include "kernels_cpu/core/camera.h"
#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/scene/scene.h"

namespace pileus {

/// A picture of linear light, [pixel][3], rows from the top.
struct Canvas {
    int width = 0, height = 0;
    Buffer<float> rgb;
};

/// Fills the canvas with one colour. kLimit: no memory.
Status make_canvas(int width, int height, const Float3& colour, Canvas& canvas);

/// colour * alpha + old * (1 - alpha).
inline void blend_over(float* pixel, const Float3& colour, float alpha) {
    for (std::size_t c = 0; c < 3; ++c) pixel[c] += (colour[c] - pixel[c]) * alpha;
}

/// A point seen by the camera: pixels from the top left corner, metres in front of the camera, and
/// pixels per metre at that depth. `visible` is false at or behind the camera.
struct Projected {
    double x = 0, y = 0, depth = 0, scale = 0;
    bool visible = false;
};
Projected project_point(const CameraParams& camera, const double (&point)[3]);

/// Pixels; `alpha` in [0, 1].
struct Disc {
    double x, y, depth;
    float radius, alpha;
    Float3 colour;
    bool ball;  ///< shaded as a ball lit from the upper left
};

/// Pixels; `width` across.
struct Line {
    double x0, y0, x1, y1, depth;
    float width, alpha;
    Float3 colour;
};

/// The line between two points in space, cut at the camera's plane; false where nothing is left.
/// Fills the ends and `depth` (of the middle) alone.
bool project_line(const CameraParams& camera, const double (&a)[3], const double (&b)[3],
                  Line& line);

/// Farthest first; equal depths keep their order.
void sort_by_depth(Span<Disc> discs);
void sort_by_depth(Span<Line> lines);

/// Draws in the order of the list. Marks narrower than a pixel fade instead of vanishing.
void draw_discs(Span<const Disc> discs, int threads, Canvas& canvas);
void draw_lines(Span<const Line> lines, int threads, Canvas& canvas);

}  // namespace pileus
