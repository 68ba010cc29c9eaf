// SPDX-License-Identifier: Apache-2.0
// A drawing as files: SVG, and PNG where its library was found.
// in: PlotDrawing -> out: STEM.svg, STEM.png.
// docs/study.md, "Plots"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "tools/study/plot_drawing.h"

namespace pileus {

Status write_drawing(const std::string& stem, const PlotDrawing& drawing) {
    constexpr int kScale = 2;
    const std::string svg = drawing_svg(drawing);
    PILEUS_TRY(write_file(stem + ".svg", {svg.data(), svg.size()}));
    if (!can_write_image("plot.png")) return Status::ok();
    int width = 0, height = 0;
    Buffer<std::uint8_t> rgb;
    Buffer<char> bytes;
    PILEUS_TRY(drawing_pixels(drawing, kScale, width, height, rgb));
    PILEUS_TRY(encode_png(width, height, rgb.span(), bytes));
    return write_file(stem + ".png", bytes.span());
}

}  // namespace pileus
