// SPDX-License-Identifier: Apache-2.0
// Writes a drawing as SVG.
// in: shapes -> out: one <svg> element, the same text on every machine.
// W3C, Scalable Vector Graphics 1.1; docs/study.md, "Plots"
#include <fmt/format.h>

#include "tools/study/plot_drawing.h"

namespace pileus {

namespace {

std::string colour_text(const PlotColour& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

/// Two places, without zeros that say nothing.
std::string place_text(double value) {
    std::string text = fmt::format("{:.2f}", value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string points_text(const std::vector<PlotXy>& points) {
    std::string text;
    for (const PlotXy& p : points)
        text += (text.empty() ? "" : " ") + place_text(p.x) + ',' + place_text(p.y);
    return text;
}

std::string opacity_text(const Shape& shape, const char* what) {
    if (shape.opacity >= 1) return "";
    return fmt::format(" {}=\"{}\"", what, place_text(shape.opacity));
}

std::string line_svg(const Shape& shape) {
    std::string text = fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\""
        " stroke-linecap=\"{}\" stroke-linejoin=\"round\"",
        points_text(shape.points), colour_text(shape.colour), place_text(shape.size),
        shape.dash > 0 ? "butt" : "round");
    if (shape.dash > 0) text += fmt::format(" stroke-dasharray=\"{}\"", place_text(shape.dash));
    return text + opacity_text(shape, "stroke-opacity") + "/>\n";
}

std::string area_svg(const Shape& shape) {
    return fmt::format("<polygon points=\"{}\" fill=\"{}\"{}/>\n", points_text(shape.points),
                       colour_text(shape.colour), opacity_text(shape, "fill-opacity"));
}

std::string text_svg(const Shape& shape) {
    const char* anchor = shape.anchor < 0 ? "start" : shape.anchor > 0 ? "end" : "middle";
    const std::string x = place_text(shape.points[0].x), y = place_text(shape.points[0].y);
    std::string turn;
    if (shape.upwards) turn = fmt::format(" transform=\"rotate(-90 {} {})\"", x, y);
    return fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n", x,
        y, place_text(shape.size), anchor, colour_text(shape.colour), turn, escape_xml(shape.text));
}

}  // namespace

std::string escape_xml(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            out += '?';
        else
            out += c;
    }
    return out;
}

std::string drawing_svg(const PlotDrawing& drawing) {
    const std::string w = place_text(drawing.width), h = place_text(drawing.height);
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\""
        " height=\"{}\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n"
        "<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n",
        w, h, w, h, w, h);
    for (const Shape& shape : drawing.shapes) {
        if (shape.points.empty()) continue;
        text += shape.kind == ShapeKind::kLine   ? line_svg(shape)
                : shape.kind == ShapeKind::kArea ? area_svg(shape)
                                                 : text_svg(shape);
    }
    return text + "</svg>\n";
}

}  // namespace pileus
