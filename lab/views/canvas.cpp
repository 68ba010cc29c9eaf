// SPDX-License-Identifier: Apache-2.0
// See canvas.h.
// in: marks -> out: blended pixels, in bands of rows that threads share.
// Every band draws all marks in order, so neither bands nor threads change a pixel.
#include "lab/views/canvas.h"

#include <algorithm>
#include <cmath>

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr int kBandRows = 16;
constexpr double kNear = 1e-3;  // share of a metre or of the line's own length before the camera

double dot3(const float (&a)[3], const double (&b)[3]) {
    return double(a[0]) * b[0] + double(a[1]) * b[1] + double(a[2]) * b[2];
}

struct Band {
    int begin, end;
};

int clamp_int(double v, int low, int high) {
    return v <= double(low) ? low : v >= double(high) ? high : int(v);
}

/// Pixels [first, end) of `count` whose centres may lie within `low` .. `high`.
Band pixels_between(double low, double high, int count) {
    return {clamp_int(std::floor(low - 0.5), 0, count), clamp_int(std::ceil(high + 0.5), 0, count)};
}

template <class Draw>
void for_bands(const Canvas& canvas, int threads, Draw draw) {
    const std::int64_t bands = (canvas.height + kBandRows - 1) / kBandRows;
    parallel_for(threads, bands, [&](std::int64_t band, int) {
        const int begin = int(band) * kBandRows;
        draw(Band{begin, std::min(begin + kBandRows, canvas.height)});
    });
}

/// Share of a pixel at `distance` from the middle of a mark of half width `half`.
double coverage(double distance, double half) {
    const double share = half + 0.5 - distance;
    // Narrower than a pixel: no place is covered by more than the mark's own width.
    const double most = half < 0.5 ? 2.0 * half : 1.0;
    return share <= 0.0 ? 0.0 : share < most ? share : most;
}

/// Light on a ball at (dx, dy) of its radius from the middle, seen from the front: Lambert's law
/// for a light from the upper left, and a little from everywhere.
float ball_shade(double dx, double dy) {
    const double r2 = std::min(dx * dx + dy * dy, 1.0), z = std::sqrt(1.0 - r2);
    const double lit = -0.41 * dx - 0.57 * dy + 0.71 * z;
    return float(0.25 + 0.75 * std::max(lit, 0.0));
}

void draw_disc(const Disc& d, Band band, Canvas& canvas) {
    const double radius = double(d.radius), reach = radius + 0.5;
    const Band rows = pixels_between(d.y - reach, d.y + reach, canvas.height);
    const Band columns = pixels_between(d.x - reach, d.x + reach, canvas.width);
    for (int y = std::max(rows.begin, band.begin); y < std::min(rows.end, band.end); ++y) {
        const double dy = double(y) + 0.5 - d.y;
        float* row = canvas.rgb.data() + std::size_t(y) * std::size_t(canvas.width) * 3;
        for (int x = columns.begin; x < columns.end; ++x) {
            const double dx = double(x) + 0.5 - d.x;
            const double share = coverage(std::sqrt(dx * dx + dy * dy), radius);
            if (!(share > 0.0)) continue;
            const float shade = d.ball ? ball_shade(dx / reach, dy / reach) : 1.0f;
            Float3 colour = d.colour;
            for (float& c : colour) c *= shade;
            blend_over(row + x * 3, colour, float(share) * d.alpha);
        }
    }
}

/// Columns of row y that a line of the given reach may touch.
Band line_columns(const Line& l, double y, double reach, int width) {
    double a = 0.0, b = 1.0;
    const double dy = l.y1 - l.y0;
    if (std::fabs(dy) > 1e-9) {
        const double s = (y - reach - l.y0) / dy, t = (y + reach - l.y0) / dy;
        a = std::max(a, std::min(s, t));
        b = std::min(b, std::max(s, t));
    }
    if (a > b) return {0, 0};
    const double x0 = l.x0 + (l.x1 - l.x0) * a, x1 = l.x0 + (l.x1 - l.x0) * b;
    return pixels_between(std::min(x0, x1) - reach, std::max(x0, x1) + reach, width);
}

void draw_line(const Line& l, Band band, Canvas& canvas) {
    const double half = 0.5 * double(l.width), reach = half + 0.5;
    const double dx = l.x1 - l.x0, dy = l.y1 - l.y0, length2 = dx * dx + dy * dy;
    const Band rows =
        pixels_between(std::min(l.y0, l.y1) - reach, std::max(l.y0, l.y1) + reach, canvas.height);
    for (int y = std::max(rows.begin, band.begin); y < std::min(rows.end, band.end); ++y) {
        const double py = double(y) + 0.5;
        const Band columns = line_columns(l, py, reach + 0.5, canvas.width);
        float* row = canvas.rgb.data() + std::size_t(y) * std::size_t(canvas.width) * 3;
        for (int x = columns.begin; x < columns.end; ++x) {
            // Measure to the nearest point of the line between its ends.
            const double ax = double(x) + 0.5 - l.x0, ay = py - l.y0;
            const double along = length2 > 0.0 ? (ax * dx + ay * dy) / length2 : 0.0;
            const double t = std::min(std::max(along, 0.0), 1.0);
            const double ox = ax - dx * t, oy = ay - dy * t;
            const double share = coverage(std::sqrt(ox * ox + oy * oy), half);
            if (share > 0.0) blend_over(row + x * 3, l.colour, float(share) * l.alpha);
        }
    }
}

template <class Mark>
void sort_marks(Span<Mark> marks) {
    std::stable_sort(marks.begin(), marks.end(),
                     [](const Mark& a, const Mark& b) { return a.depth > b.depth; });
}

}  // namespace

Status make_canvas(int width, int height, const Float3& colour, Canvas& canvas) {
    canvas.width = width;
    canvas.height = height;
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    PILEUS_TRY(canvas.rgb.resize(pixels * 3, "canvas"));
    for (std::size_t i = 0; i < canvas.rgb.size(); ++i) canvas.rgb[i] = colour[i % 3];
    return Status::ok();
}

Projected project_point(const CameraParams& camera, const double (&point)[3]) {
    double from[3];
    for (int a = 0; a < 3; ++a) from[a] = point[a] - double(camera.origin[a]);
    Projected p;
    p.depth = dot3(camera.forward, from);
    p.visible = camera.orthographic != 0 || p.depth > 0.0;
    if (!p.visible) return p;
    const double distance = camera.orthographic != 0 ? 1.0 : p.depth;
    p.scale = 0.5 * double(camera.height) / (double(camera.half_height) * distance);
    p.x = 0.5 * double(camera.width) + dot3(camera.right, from) * p.scale;
    p.y = 0.5 * double(camera.height) - dot3(camera.up, from) * p.scale;
    return p;
}

bool project_line(const CameraParams& camera, const double (&a)[3], const double (&b)[3],
                  Line& line) {
    double ends[2][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}};
    if (camera.orthographic == 0) {
        double depth[2], length2 = 0;
        for (int e = 0; e < 2; ++e) {
            depth[e] = 0;
            for (int i = 0; i < 3; ++i)
                depth[e] += double(camera.forward[i]) * (ends[e][i] - double(camera.origin[i]));
        }
        for (int i = 0; i < 3; ++i) length2 += (b[i] - a[i]) * (b[i] - a[i]);
        // Cut just before the camera, where the projection still has a size.
        const double near = kNear * std::sqrt(length2);
        if (!(depth[0] > near) && !(depth[1] > near)) return false;
        for (int e = 0; e < 2; ++e) {
            if (depth[e] > near) continue;
            const double t = (near - depth[e]) / (depth[1 - e] - depth[e]);
            for (int i = 0; i < 3; ++i) ends[e][i] += (ends[1 - e][i] - ends[e][i]) * t;
        }
    }
    const Projected p = project_point(camera, ends[0]), q = project_point(camera, ends[1]);
    if (!p.visible || !q.visible) return false;
    line.x0 = p.x;
    line.y0 = p.y;
    line.x1 = q.x;
    line.y1 = q.y;
    line.depth = 0.5 * (p.depth + q.depth);
    return true;
}

void sort_by_depth(Span<Disc> discs) { sort_marks(discs); }
void sort_by_depth(Span<Line> lines) { sort_marks(lines); }

void draw_discs(Span<const Disc> discs, int threads, Canvas& canvas) {
    for_bands(canvas, threads, [&](Band band) {
        for (const Disc& d : discs) draw_disc(d, band, canvas);
    });
}

void draw_lines(Span<const Line> lines, int threads, Canvas& canvas) {
    for_bands(canvas, threads, [&](Band band) {
        for (const Line& l : lines) draw_line(l, band, canvas);
    });
}

}  // namespace pileus
