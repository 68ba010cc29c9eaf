// SPDX-License-Identifier: Apache-2.0
// What keys and mice do to the view, the sun and the viewer.
// in: an event, the state before -> out: the state after.
// Elek 2011, appendix B.3; docs/view.md.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tools/view/window.h"

namespace pileus::view {

using Point = std::array<double, 3>;

/// The media's box, in the middle of what one looks at.
struct Box {
    Point low{}, high{};
    Point middle() const;
    double radius() const;  ///< of the ball around it
};

struct View {
    Point position{}, target{}, up{0, 0, 1};
    double fov_deg = 40;
    double azimuth_deg = 0, elevation_deg = 45;  ///< of the sun
    double day_share = -1;  ///< where the slider was set; below 0: nowhere, or the sun left it
};

constexpr int kMethods = 5;
/// Names of the methods on the number keys.
const char* method_named(int number);

enum class Shown { kColour, kAlpha, kDepth };

/// What the loop has to do, besides drawing.
struct State {
    View view, home;  ///< now, and where it began
    Box box;
    double lowest_m = -1e9;  ///< the camera's least height
    bool has_sun = true;
    int width = 1280, height = 720;
    Shown shown = Shown::kColour;
    bool help = false, lit = true, ended = false;
    int method = 0;           ///< 0: the scene's own; 1 to kMethods
    bool screenshot = false;  ///< asked for; the loop takes it back
    bool moved = false, sun_moved = false, method_changed = false;  ///< likewise
    Button held = Button::kNone;
    bool slides = false;  ///< the mouse holds the day's slider
    /// Where the sun stands at a share of the slider; empty: `set_day`.
    std::function<void(double, View&)> sun_at;
};

/// Height of the slider at the lower edge, pixels.
constexpr int kSliderHeight = 24;
/// Share of the day from sunrise to sunset at which the sun stands; it rises in the east.
void set_day(double share, View& view);
double day_of(const View& view);

void apply(const Event& event, State& state);

/// What F1 shows.
std::vector<std::string> help_lines();

}  // namespace pileus::view
