// SPDX-License-Identifier: Apache-2.0
// Places axes, bands, curves, floors and the legend of a plot.
// in: a Plot -> out: shapes.
// Colours: Okabe and Ito 2008, "Color universal design"; docs/study.md, "Plots"
#include "tools/study/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pileus {

namespace {

constexpr double kWidth = 860, kHeight = 440;
constexpr double kLeft = 70, kRight = 570, kTop = 44, kBottom = 382;
constexpr double kWords = 12;
constexpr PlotColour kInk{40, 44, 52}, kGrey{120, 124, 132}, kGrid{226, 229, 234},
    kFine{242, 244, 247}, kWhite{255, 255, 255};

/// A logarithmic axis: a value's place between two ends.
struct Axis {
    double low = 1, high = 10;  ///< values
    double from = 0, to = 1;    ///< places

    bool holds(double value) const { return value >= low * 0.999 && value <= high * 1.001; }
    double place(double value) const {
        const double held = std::min(std::max(value, low), high);
        return from + (to - from) * std::log10(held / low) / std::log10(high / low);
    }
};

double decade_below(double value) { return std::pow(10, std::floor(std::log10(value) + 1e-9)); }

/// The largest of 1, 2, 5 times a power of ten that is not above `value`.
double step_below(double value) {
    const double decade = decade_below(value);
    const double times = value / decade * (1 + 1e-9);
    return decade * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
}

double step_above(double value) {
    const double below = step_below(value);
    if (below >= value * (1 - 1e-9)) return below;
    const double times = below / decade_below(below);
    return below * (times > 1.5 && times < 2.5 ? 2.5 : 2);
}

class Plotter {
public:
    explicit Plotter(const Plot& plot) : plot_(plot) {
        drawing_.width = kWidth;
        drawing_.height = kHeight;
        x_.from = kLeft;
        x_.to = kRight;
        y_.from = kBottom;
        y_.to = kTop;
        find_ranges();
    }

    PlotDrawing draw() {
        words({kLeft, 24}, plot_.title, 15, -1, kInk);
        grid(x_, true);
        grid(y_, false);
        line({{kLeft, kTop}, {kLeft, kBottom}, {kRight, kBottom}}, kGrey, 1, 0);
        words({0.5 * (kLeft + kRight), kHeight - 16}, plot_.x_label, kWords, 0, kInk);
        words({20, 0.5 * (kTop + kBottom)}, plot_.y_label, kWords, 0, kInk, true);
        for (std::size_t i = 0; i < plot_.series.size(); ++i) band(plot_.series[i], i);
        level();
        for (std::size_t i = 0; i < plot_.series.size(); ++i) floor_line(plot_.series[i], i);
        for (std::size_t i = 0; i < plot_.series.size(); ++i) curve(plot_.series[i], i);
        legend();
        return std::move(drawing_);
    }

private:
    static bool shown(const PlotPoint& p) { return p.x > 0 && p.y > 0; }

    void find_ranges() {
        double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
        const auto take = [](double value, double& low, double& high) {
            low = low > 0 ? std::min(low, value) : value;
            high = std::max(high, value);
        };
        for (const PlotSeries& series : plot_.series)
            for (const PlotPoint& p : series.points) {
                if (!shown(p)) continue;
                take(p.x, x0, x1);
                take(p.y, y0, y1);
                if (p.high > 0) y1 = std::max(y1, p.high);
            }
        if (!(x0 > 0)) x0 = x1 = y0 = y1 = 1;
        // Floors and the level widen the range by up to a decade and a half each.
        const double lowest = y0 / 30;
        for (const PlotSeries& series : plot_.series)
            if (series.floor > lowest) y0 = std::min(y0, series.floor);
        if (plot_.level > lowest) y0 = std::min(y0, plot_.level);
        x_.low = step_below(x0 * 0.9);
        x_.high = step_above(x1 * 1.1);
        y_.low = decade_below(y0 * 0.95);
        y_.high = y1 / decade_below(y1) > 1.05 ? 10 * decade_below(y1) : decade_below(y1);
        if (!(y_.high > y_.low)) y_.high = 10 * y_.low;
        if (!(x_.high > x_.low)) x_.high = 10 * x_.low;
    }

    void grid(const Axis& axis, bool is_x) {
        const bool few = axis.high / axis.low < 150;
        for (double decade = decade_below(axis.low); decade <= axis.high * 1.001; decade *= 10)
            for (int times = 1; times < 10; ++times) {
                const double value = decade * times;
                if (!axis.holds(value)) continue;
                const double at = axis.place(value);
                const bool main = times == 1;
                const std::vector<PlotXy> ends =
                    is_x ? std::vector<PlotXy>{{at, kTop}, {at, kBottom}}
                         : std::vector<PlotXy>{{kLeft, at}, {kRight, at}};
                line(ends, main ? kGrid : kFine, 1, 0);
                if (main || (is_x && few && (times == 2 || times == 5))) label(value, at, is_x);
            }
    }

    void label(double value, double at, bool is_x) {
        if (is_x && value >= 0.00099 && value < 99999)
            return words({at, kBottom + 18}, fmt::format("{:.3g}", value), kWords, 0, kInk);
        const int power = int(std::floor(std::log10(value) + 0.5));
        const PlotXy place = is_x ? PlotXy{at + 2, kBottom + 18} : PlotXy{kLeft - 20, at + 5};
        words(place, "10", kWords, 1, kInk);
        words({place.x + 1.5, place.y - 5}, fmt::format("{}", power), 9, -1, kInk);
    }

    void band(const PlotSeries& series, std::size_t i) {
        Shape shape;
        shape.kind = ShapeKind::kArea;
        shape.colour = series_colour(i);
        shape.opacity = 0.16;
        std::vector<PlotXy> back;
        for (const PlotPoint& p : series.points) {
            if (!shown(p)) continue;
            shape.points.push_back({x_.place(p.x), y_.place(std::max(p.high, p.y))});
            const double low = p.low > 0 ? std::min(p.low, p.y) : y_.low;
            back.push_back({x_.place(p.x), y_.place(p.high > p.low ? low : p.y)});
        }
        if (back.size() < 2) return;
        shape.points.insert(shape.points.end(), back.rbegin(), back.rend());
        drawing_.shapes.push_back(std::move(shape));
    }

    void level() {
        if (!(plot_.level > 0) || !y_.holds(plot_.level)) return;
        const double at = y_.place(plot_.level);
        line({{kLeft, at}, {kRight, at}}, kGrey, 1.2, 2);
    }

    /// From the middle of the curve to the end, where it is what remains.
    void floor_line(const PlotSeries& series, std::size_t i) {
        if (!(series.floor > 0) || !y_.holds(series.floor)) return;
        double first = 0;
        for (const PlotPoint& p : series.points)
            if (shown(p) && !(first > 0)) first = p.x;
        if (!(first > 0)) return;
        const double at = y_.place(series.floor), begin = x_.place(first);
        line({{begin, at}, {kRight, at}}, series_colour(i), 1.2, 6);
    }

    void curve(const PlotSeries& series, std::size_t i) {
        std::vector<PlotXy> points;
        for (const PlotPoint& p : series.points)
            if (shown(p)) points.push_back({x_.place(p.x), y_.place(p.y)});
        if (points.empty()) return;
        line(points, series_colour(i), 2, 0);
        for (const PlotPoint& p : series.points) {
            if (!shown(p)) continue;
            const PlotXy at{x_.place(p.x), y_.place(p.y)};
            // A ring is three dots over one another: the curve below does not show through.
            if (p.marked) {
                line({at}, series_colour(i), 14, 0);
                line({at}, kWhite, 11, 0);
            }
            mark(at, i);
        }
    }

    /// Dot, square, diamond or triangle: the series can be told without colours.
    void mark(PlotXy at, std::size_t i) {
        if (i % 4 == 0) return line({at}, series_colour(i), 7.5, 0);
        const double r = i % 4 == 1 ? 3.2 : 4.4;
        Shape shape;
        shape.kind = ShapeKind::kArea;
        shape.colour = series_colour(i);
        if (i % 4 == 1)
            shape.points = {{at.x - r, at.y - r},
                            {at.x + r, at.y - r},
                            {at.x + r, at.y + r},
                            {at.x - r, at.y + r}};
        else if (i % 4 == 2)
            shape.points = {{at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y}};
        else
            shape.points = {
                {at.x, at.y - r}, {at.x + r, at.y + 0.8 * r}, {at.x - r, at.y + 0.8 * r}};
        drawing_.shapes.push_back(std::move(shape));
    }

    void legend() {
        constexpr double kX = kRight + 22;
        double y = kTop + 8;
        bool any_floor = false;
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            line({{kX, y}, {kX + 26, y}}, series_colour(i), 2, 0);
            mark({kX + 13, y}, i);
            words({kX + 34, y + 4}, plot_.series[i].label, kWords, -1, kInk);
            any_floor = any_floor || (plot_.series[i].floor > 0 && y_.holds(plot_.series[i].floor));
            y += 21;
        }
        y += 8;
        if (any_floor) {
            line({{kX, y}, {kX + 26, y}}, kGrey, 1.2, 6);
            words({kX + 34, y + 4}, "bias floor of the fit", kWords, -1, kInk);
            y += 21;
        }
        if (plot_.level > 0 && y_.holds(plot_.level)) {
            line({{kX, y}, {kX + 26, y}}, kGrey, 1.2, 2);
            words({kX + 34, y + 4}, plot_.level_label, kWords, -1, kInk);
            y += 21;
        }
        if (plot_.mark_label.empty()) return;
        line({{kX + 13, y}}, kGrey, 14, 0);
        line({{kX + 13, y}}, kWhite, 11, 0);
        line({{kX + 13, y}}, kGrey, 7.5, 0);
        words({kX + 34, y + 4}, plot_.mark_label, kWords, -1, kInk);
    }

    void line(std::vector<PlotXy> points, PlotColour colour, double size, double dash) {
        Shape shape;
        shape.points = std::move(points);
        // One point is a dot; SVG draws it as a line without length and with round ends.
        if (shape.points.size() == 1) shape.points.push_back(shape.points[0]);
        shape.colour = colour;
        shape.size = size;
        shape.dash = dash;
        drawing_.shapes.push_back(std::move(shape));
    }

    void words(PlotXy at, const std::string& text, double size, int anchor, PlotColour colour,
               bool upwards = false) {
        Shape shape;
        shape.kind = ShapeKind::kText;
        shape.points = {at};
        shape.text = text;
        shape.size = size;
        shape.anchor = anchor;
        shape.colour = colour;
        shape.upwards = upwards;
        drawing_.shapes.push_back(std::move(shape));
    }

    const Plot& plot_;
    Axis x_, y_;
    PlotDrawing drawing_;
};

}  // namespace

PlotColour series_colour(std::size_t i) {
    constexpr PlotColour kColours[8] = {{0, 114, 178},   {213, 94, 0},   {0, 158, 115},
                                        {204, 121, 167}, {230, 159, 0},  {86, 180, 233},
                                        {90, 60, 150},   {110, 110, 110}};
    return kColours[i % 8];
}

PlotDrawing draw_plot(const Plot& plot) { return Plotter(plot).draw(); }

}  // namespace pileus
