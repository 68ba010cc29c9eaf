// SPDX-License-Identifier: Apache-2.0
// Draws shapes into pixels with smooth edges.
// in: shapes -> out: 8-bit RGB; coordinates are rounded to 1/64 pixel first, then only + - * / and
// square roots, so that the bytes are the same everywhere. docs/study.md, "Plots"
#include <algorithm>
#include <cmath>

#include "tools/study/plot_drawing.h"

namespace pileus {

namespace {

constexpr int kFine = 4;  // rows of samples in a pixel for areas

double on_grid(double value) { return std::floor(value * 64 + 0.5) / 64; }

/// Distance of a point from a piece of a straight line.
double distance(PlotXy p, PlotXy a, PlotXy b) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0;
    t = std::min(std::max(t, 0.0), 1.0);
    const double ex = p.x - (a.x + t * dx), ey = p.y - (a.y + t * dy);
    return std::sqrt(ex * ex + ey * ey);
}

class Canvas {
public:
    Canvas(int width, int height, int scale, std::uint8_t* rgb, float* cover)
        : width_(width), height_(height), scale_(scale), rgb_(rgb), cover_(cover) {
        std::fill(rgb_, rgb_ + std::size_t(width) * std::size_t(height) * 3, std::uint8_t(255));
    }

    void draw(const Shape& shape) {
        clear();
        if (shape.kind == ShapeKind::kArea) {
            area(shape.points);
        } else if (shape.kind == ShapeKind::kLine) {
            line(shape.points, shape.size, shape.dash);
        } else {
            words(shape);
        }
        blend(shape.colour, shape.opacity);
    }

private:
    PlotXy placed(PlotXy p) const { return {on_grid(p.x * scale_), on_grid(p.y * scale_)}; }

    /// Forgets the rectangle that the last shape covered.
    void clear() {
        left_ = width_;
        top_ = height_;
        right_ = bottom_ = 0;
    }

    /// Makes the covered rectangle hold another one; new places begin uncovered.
    void reach(double x0, double y0, double x1, double y1) {
        const int l = std::max(0, int(std::floor(std::max(x0, 0.0))));
        const int t = std::max(0, int(std::floor(std::max(y0, 0.0))));
        const int r = std::min(width_, int(std::ceil(std::min(x1, double(width_)))) + 1);
        const int b = std::min(height_, int(std::ceil(std::min(y1, double(height_)))) + 1);
        const int nl = std::min(l, left_), nt = std::min(t, top_);
        const int nr = std::max(r, right_), nb = std::max(b, bottom_);
        for (int y = nt; y < nb; ++y)
            for (int x = nl; x < nr; ++x) {
                const bool old = x >= left_ && x < right_ && y >= top_ && y < bottom_;
                if (!old) cover_[at(x, y)] = 0;
            }
        left_ = nl;
        top_ = nt;
        right_ = nr;
        bottom_ = nb;
    }

    std::size_t at(int x, int y) const {
        return std::size_t(y) * std::size_t(width_) + std::size_t(x);
    }

    /// A line is where its pieces are; overlaps count once.
    void piece(PlotXy a, PlotXy b, double half) {
        const double edge = half + 1;
        const double x0 = std::min(a.x, b.x) - edge, x1 = std::max(a.x, b.x) + edge;
        const double y0 = std::min(a.y, b.y) - edge, y1 = std::max(a.y, b.y) + edge;
        if (x1 < 0 || y1 < 0 || x0 >= width_ || y0 >= height_) return;
        reach(x0, y0, x1, y1);
        for (int y = std::max(0, int(y0)); y < std::min(height_, int(y1) + 1); ++y)
            for (int x = std::max(0, int(x0)); x < std::min(width_, int(x1) + 1); ++x) {
                const double d = distance({x + 0.5, y + 0.5}, a, b);
                const double c = std::min(std::max(half + 0.5 - d, 0.0), 1.0);
                float& cover = cover_[at(x, y)];
                cover = std::max(cover, float(c));
            }
    }

    void line(const std::vector<PlotXy>& points, double size, double dash) {
        const double half = on_grid(0.5 * size * scale_);
        if (points.size() == 1) piece(placed(points[0]), placed(points[0]), half);
        double along = 0;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const PlotXy a = placed(points[i - 1]), b = placed(points[i]);
            if (dash > 0)
                dashes(a, b, half, dash * scale_, along);
            else
                piece(a, b, half);
        }
    }

    /// Cuts a piece into dashes; `along` carries the length so far over the corners.
    void dashes(PlotXy a, PlotXy b, double half, double dash, double& along) {
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double length = std::sqrt(dx * dx + dy * dy);
        for (double s = 0; s < length;) {
            const double phase = along / dash, turn = std::floor(phase);
            const double rest = std::max((turn + 1 - phase) * dash, 1e-3);
            const double end = std::min(s + rest, length);
            const bool on = std::fmod(turn, 2.0) < 1;
            if (on)
                piece({a.x + dx * s / length, a.y + dy * s / length},
                      {a.x + dx * end / length, a.y + dy * end / length}, half);
            along += end - s;
            s = end;
        }
    }

    void area(const std::vector<PlotXy>& points) {
        std::vector<PlotXy> corners;
        double x0 = width_, y0 = height_, x1 = 0, y1 = 0;
        for (const PlotXy& p : points) {
            corners.push_back(placed(p));
            x0 = std::min(x0, corners.back().x);
            y0 = std::min(y0, corners.back().y);
            x1 = std::max(x1, corners.back().x);
            y1 = std::max(y1, corners.back().y);
        }
        reach(x0, y0, x1, y1);
        std::vector<double> cuts;
        for (int y = top_; y < bottom_; ++y)
            for (int sub = 0; sub < kFine; ++sub) {
                const double level = y + (sub + 0.5) / kFine;
                cuts.clear();
                for (std::size_t i = 0; i < corners.size(); ++i) {
                    const PlotXy a = corners[i], b = corners[(i + 1) % corners.size()];
                    if ((a.y <= level) == (b.y <= level)) continue;
                    cuts.push_back(a.x + (b.x - a.x) * (level - a.y) / (b.y - a.y));
                }
                std::sort(cuts.begin(), cuts.end());
                for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) span(y, cuts[i], cuts[i + 1]);
            }
    }

    void span(int y, double from, double to) {
        const int first = std::max(left_, int(from)), last = std::min(right_, int(to) + 1);
        for (int x = first; x < last; ++x) {
            const double part = std::min(to, x + 1.0) - std::max(from, double(x));
            cover_[at(x, y)] += float(std::max(part, 0.0) / kFine);
        }
    }

    void words(const Shape& shape) {
        double width = 0;
        const auto strokes = text_strokes(shape.text, width);
        const double size = shape.size;
        const double shift = shape.anchor < 0 ? 0 : shape.anchor > 0 ? width : 0.5 * width;
        for (const auto& stroke : strokes) {
            std::vector<PlotXy> points;
            for (const PlotXy& p : stroke) {
                const double along = (p.x - shift) * size, down = p.y * size;
                const PlotXy origin = shape.points[0];
                points.push_back(shape.upwards ? PlotXy{origin.x + down, origin.y - along}
                                               : PlotXy{origin.x + along, origin.y + down});
            }
            line(points, 0.085 * size, 0);
        }
    }

    void blend(const PlotColour& colour, double opacity) {
        for (int y = top_; y < bottom_; ++y)
            for (int x = left_; x < right_; ++x) {
                const double share = std::min(double(cover_[at(x, y)]), 1.0) * opacity;
                if (!(share > 0)) continue;
                std::uint8_t* pixel = rgb_ + 3 * at(x, y);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double value = pixel[c] + share * (double(colour[c]) - pixel[c]);
                    pixel[c] = std::uint8_t(value + 0.5);
                }
            }
    }

    int width_, height_, scale_;
    std::uint8_t* rgb_;
    float* cover_;
    int left_ = 0, top_ = 0, right_ = 0, bottom_ = 0;
};

}  // namespace

Status drawing_pixels(const PlotDrawing& drawing, int scale, int& width, int& height,
                      Buffer<std::uint8_t>& rgb) {
    constexpr double kMaxSide = 4096;
    const bool sound = drawing.width >= 1 && drawing.width <= kMaxSide && drawing.height >= 1 &&
                       drawing.height <= kMaxSide && scale >= 1 && scale <= 8;
    if (!sound) return Status::bad_input("drawing: size: out of range, allowed: 1 to 4096, 1 to 8");
    width = int(drawing.width) * scale;
    height = int(drawing.height) * scale;
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    Buffer<float> cover;
    PILEUS_TRY(rgb.resize(pixels * 3, "drawing"));
    PILEUS_TRY(cover.resize(pixels, "drawing"));
    Canvas canvas(width, height, scale, rgb.data(), cover.data());
    for (const Shape& shape : drawing.shapes)
        if (!shape.points.empty()) canvas.draw(shape);
    return Status::ok();
}

}  // namespace pileus
