// SPDX-License-Identifier: Apache-2.0
// Text, a graph of frame times and a slider, drawn over a finished picture.
// in: bytes R G B A -> out: the same, drawn upon.
// docs/view.md
#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace pileus::view {

struct Canvas {
    std::uint8_t* pixels;  ///< four bytes a pixel, rows from the top
    int width, height;
};

/// Lines of capital letters, digits and .,:/%+-()=<>; others show as blanks. Each on a dark ground.
void draw_text(const Canvas& canvas, int x, int y, int scale,
               const std::vector<std::string>& lines);
/// Bars of seconds, the newest at the right; a line where `target_s` is.
void draw_times(const Canvas& canvas, int x, int y, int width, int height,
                const std::deque<double>& seconds, double target_s);
/// A line along the lower edge and a mark at a share of it.
void draw_slider(const Canvas& canvas, int height, double share);

}  // namespace pileus::view
