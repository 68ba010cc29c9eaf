// SPDX-License-Identifier: Apache-2.0
// Curves on logarithmic axes: points with a band, dashed floors, marked points, a level.
// in: numbers -> out: a PlotDrawing, for SVG and for pixels.
// docs/study.md, "Plots"
#pragma once
#include <string>
#include <vector>

#include "tools/study/plot_drawing.h"

namespace pileus {

struct PlotPoint {
    double x = 0, y = 0;
    double low = 0, high = 0;  ///< of the band; equal where there is none
    bool marked = false;       ///< ringed
};

struct PlotSeries {
    std::string label;
    std::vector<PlotPoint> points;  ///< in order of x; those with x <= 0 or y <= 0 are left out
    double floor = 0;               ///< dashed line in the series' colour; <= 0: none
};

struct Plot {
    std::string title, x_label, y_label;
    std::vector<PlotSeries> series;
    double level = 0;                     ///< grey line over the whole width; <= 0: none
    std::string level_label, mark_label;  ///< in the legend; the latter for marked points
};

/// 860 x 440 units. Both axes are logarithmic and reach to whole decades in y, to 1, 2 or 5 times a
/// decade in x. A floor far below all points is left out.
PlotDrawing draw_plot(const Plot& plot);

/// Colour of series number i; eight that people with any colour vision can tell apart, then again.
PlotColour series_colour(std::size_t i);

}  // namespace pileus
