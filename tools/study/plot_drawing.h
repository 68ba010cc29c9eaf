// SPDX-License-Identifier: Apache-2.0
// A drawing of lines, areas, dots and words, and its two forms: SVG text and pixels.
// in: shapes in units of one pixel, y down -> out: SVG 1.1, or 8-bit RGB with smooth edges.
// docs/study.md, "Plots"
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/buffer.h"
#include "src/base/status.h"

namespace pileus {

struct PlotXy {
    double x = 0, y = 0;
};

using PlotColour = std::array<std::uint8_t, 3>;  ///< sRGB

enum class ShapeKind {
    kLine,  ///< through all points
    kArea,  ///< polygon, filled
    kText   ///< at the first point: left end of the baseline for `anchor` -1, middle 0, right end 1
};

struct Shape {
    ShapeKind kind = ShapeKind::kLine;
    std::vector<PlotXy> points;
    PlotColour colour{0, 0, 0};
    double opacity = 1;
    double size = 1;  ///< width of the line; height of the words in the manner of a font's size
    double dash = 0;  ///< length of a dash, and of the gap behind it; 0: unbroken
    int anchor = -1;
    bool upwards = false;  ///< words that run from below
    std::string text;
};

struct PlotDrawing {
    double width = 0, height = 0;
    std::vector<Shape> shapes;  ///< later ones over earlier ones
};

/// One <svg> element with a white ground; coordinates rounded to 0.01. Characters that XML reserves
/// are escaped, control characters become '?'.
std::string drawing_svg(const PlotDrawing& drawing);

/// The drawing on white, `scale` pixels for each unit (1 to 8), rows from the top, 3 bytes a pixel.
/// Words are drawn in a font of straight strokes that knows ASCII; anything else becomes a box.
Status drawing_pixels(const PlotDrawing& drawing, int scale, int& width, int& height,
                      Buffer<std::uint8_t>& rgb);

/// Writes STEM.svg, and STEM.png where images can be written as PNG. kIo, kLimit.
Status write_drawing(const std::string& stem, const PlotDrawing& drawing);

/// Strokes of a text in the font of drawing_pixels: polylines in units of its size, from (0, 0) on
/// the baseline's left end, y down; `width` gets where the next letter would begin.
std::vector<std::vector<PlotXy>> text_strokes(const std::string& text, double& width);

/// `text` with & < > " ' as entities and control characters as '?'; for SVG and HTML.
std::string escape_xml(const std::string& text);

}  // namespace pileus
