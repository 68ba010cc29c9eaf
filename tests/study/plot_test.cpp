// SPDX-License-Identifier: Apache-2.0
// Plots: the same bytes everywhere, inside their frame, in both forms.
// in: fixed curves -> out: digests of SVG text and of pixels.
// docs/study.md, "Plots"
#include "tools/study/plot.h"

#include <doctest/doctest.h>

#include <cmath>

#include "src/base/digest.h"
#include "tools/study/study_report.h"

using namespace pileus;

namespace {

Plot sample_plot() {
    Plot plot;
    plot.title = "Cumulus <at> \"noon\" & after";
    plot.x_label = "CPU time, seconds";
    plot.y_label = "relMSE";
    plot.level = 2e-4;
    plot.level_label = "noise of the reference";
    plot.mark_label = "on the Pareto front";
    for (int s = 0; s < 5; ++s) {
        PlotSeries series;
        series.label = "method " + std::to_string(s + 1);
        series.floor = 4e-4 * (s + 1);
        double t = 0.1 * (s + 1);
        for (int i = 0; i < 5; ++i, t *= 4) {
            const double y = series.floor + 0.02 / t;
            series.points.push_back({t, y, 0.8 * y, 1.25 * y, i % 2 == s % 2});
        }
        plot.series.push_back(series);
    }
    return plot;
}

std::string digest_of(const std::string& text) {
    Digest digest;
    digest.text(text);
    return digest.hex();
}

std::string digest_of(const Buffer<std::uint8_t>& bytes) {
    Digest digest;
    digest.bytes(bytes.data(), bytes.size());
    return digest.hex();
}

}  // namespace

TEST_CASE("a plot is the same text and the same pixels on every machine") {
    const PlotDrawing drawing = draw_plot(sample_plot());
    CHECK(digest_of(drawing_svg(drawing)) == "c8dd308ae287692c");
    int width = 0, height = 0;
    Buffer<std::uint8_t> rgb;
    REQUIRE(drawing_pixels(drawing, 2, width, height, rgb));
    CHECK(width == 1720);
    CHECK(height == 880);
    CHECK(digest_of(rgb) == "453a785a48433899");
}

TEST_CASE("everything lies on the paper, and the points where the axes say") {
    const PlotDrawing drawing = draw_plot(sample_plot());
    for (const Shape& shape : drawing.shapes)
        for (const PlotXy& p : shape.points) {
            CHECK(p.x >= 0);
            CHECK(p.x <= drawing.width);
            CHECK(p.y >= 0);
            CHECK(p.y <= drawing.height);
        }
    // Two points a decade apart in y, and two in x, are as far apart as two others.
    Plot plot;
    PlotSeries series;
    for (double x : {1.0, 10.0, 100.0}) series.points.push_back({x, x / 1000, 0, 0, false});
    plot.series.push_back(series);
    const PlotDrawing line = draw_plot(plot);
    for (const Shape& shape : line.shapes)
        if (shape.size == 2 && shape.points.size() == 3) {
            const auto& p = shape.points;
            CHECK(p[1].x - p[0].x == doctest::Approx(p[2].x - p[1].x));
            CHECK(p[0].y - p[1].y == doctest::Approx(p[1].y - p[2].y));
            CHECK(p[1].x > p[0].x);
            CHECK(p[1].y < p[0].y);
        }
}

TEST_CASE("plots of nothing, of one point, of values that no axis holds") {
    Plot plot;
    CHECK(draw_plot(plot).shapes.size() > 10);
    PlotSeries series;
    series.points = {{0, 1, 0, 0, false}, {1, -1, 0, 0, true}, {2, std::nan(""), 0, 0, true}};
    plot.series.push_back(series);
    plot.series.push_back(series);
    plot.series[1].points.push_back({1, 1, 1, 1, true});
    for (const Shape& shape : draw_plot(plot).shapes)
        for (const PlotXy& p : shape.points) CHECK((std::isfinite(p.x) && std::isfinite(p.y)));
}

TEST_CASE("words become strokes, and reserved characters entities") {
    double width = 0;
    CHECK(text_strokes("", width).empty());
    CHECK(width == 0);
    std::string ascii;
    for (char c = ' '; c <= '~'; ++c) ascii += c;
    // Every printable letter has strokes of its own, inside its cell.
    for (char c : ascii) {
        double w = 0;
        const auto strokes = text_strokes(std::string(1, c), w);
        CHECK((c == ' ') == strokes.empty());
        for (const auto& stroke : strokes)
            for (const PlotXy& p : stroke) {
                CHECK(p.x >= 0);
                CHECK(p.x <= w);
                CHECK(p.y >= -0.72 - 1e-9);
                CHECK(p.y <= 0.24 + 1e-9);
            }
    }
    // A letter of two bytes is one box.
    double two = 0, box = 0;
    (void)text_strokes("\xC3\xA9", two);
    (void)text_strokes("\x01", box);
    CHECK(two == box);
    const std::string svg = drawing_svg(draw_plot(sample_plot()));
    CHECK(svg.find("Cumulus &lt;at&gt; &quot;noon&quot; &amp; after") != std::string::npos);
    CHECK(escape_xml("a\nb'") == "a?b&#39;");
}

TEST_CASE("a drawing of no size is refused") {
    PlotDrawing drawing;
    int width = 0, height = 0;
    Buffer<std::uint8_t> rgb;
    CHECK(drawing_pixels(drawing, 1, width, height, rgb).code == Code::kBadInput);
    drawing.width = drawing.height = 10;
    CHECK(drawing_pixels(drawing, 9, width, height, rgb).code == Code::kBadInput);
    CHECK(drawing_pixels(drawing, 1, width, height, rgb));
    CHECK(rgb[0] == 255);
}

TEST_CASE("base64 as published (RFC 4648, section 10)") {
    const char* const rows[][2] = {{"", ""},
                                   {"f", "Zg=="},
                                   {"fo", "Zm8="},
                                   {"foo", "Zm9v"},
                                   {"foob", "Zm9vYg=="},
                                   {"fooba", "Zm9vYmE="},
                                   {"foobar", "Zm9vYmFy"}};
    for (const auto& row : rows) CHECK(base64(row[0], std::strlen(row[0])) == row[1]);
}
