// SPDX-License-Identifier: Apache-2.0
// See controls.h.
#include "tools/view/controls.h"

#include <algorithm>
#include <cmath>

#include "src/base/angles.h"

namespace pileus::view {
namespace {

constexpr double kStep = 0.03;        // of the way to the target, a key
constexpr double kTurnDegrees = 0.2;  // a pixel of the mouse
constexpr double kSteepest = 89;      // degrees of the view
constexpr double kHighestSun = 66, kLowestSun = -6;

Point add(const Point& a, const Point& b, double scale) {
    return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}
Point way(const Point& from, const Point& to) { return add(to, from, -1); }
double length(const Point& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
Point unit(const Point& v) {
    const double l = length(v);
    return l > 0 ? Point{v[0] / l, v[1] / l, v[2] / l} : Point{0, 1, 0};
}
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A way as distance, angle from north over east, angle above the horizon.
struct Polar {
    double distance, azimuth_deg, elevation_deg;
};
Polar polar(const Point& v) {
    constexpr double kDegrees = 57.29577951308232;
    const double side = std::sqrt(v[0] * v[0] + v[1] * v[1]);
    return {length(v), std::atan2(v[0], v[1]) * kDegrees, std::atan2(v[2], side) * kDegrees};
}
Point cartesian(const Polar& p) {
    const SineCosine e = sincos_deg(p.elevation_deg), a = sincos_deg(p.azimuth_deg);
    return {p.distance * e.cosine * a.sine, p.distance * e.cosine * a.cosine, p.distance * e.sine};
}
double held(double v, double low, double high) { return std::min(std::max(v, low), high); }

/// Moves eye and target alike.
void shift(const Point& by, double scale, View& view) {
    view.position = add(view.position, by, scale);
    view.target = add(view.target, by, scale);
}

void turn(double right_deg, double up_deg, View& view) {
    Polar p = polar(way(view.position, view.target));
    p.azimuth_deg += right_deg;
    p.elevation_deg = held(p.elevation_deg + up_deg, -kSteepest, kSteepest);
    view.target = add(view.position, cartesian(p), 1);
}

void revolve(double right_deg, double up_deg, const Box& box, View& view) {
    Polar p = polar(way(box.middle(), view.position));
    p.azimuth_deg += right_deg;
    p.elevation_deg = held(p.elevation_deg + up_deg, -kSteepest, kSteepest);
    view.position = add(box.middle(), cartesian(p), 1);
    view.target = box.middle();
}

/// Nearer to the target, or away from it.
void dolly(double share, View& view) {
    const Point ahead = way(view.position, view.target);
    view.position = add(view.position, ahead, std::min(share, 0.9));
}

/// So far from the cloud that all of it is seen, from where one is.
void frame(const Box& box, View& view) {
    const double half = sincos_deg(0.5 * view.fov_deg).sine;
    const Point from = unit(way(box.middle(), view.position));
    view.position = add(box.middle(), from, 1.1 * box.radius() / half);
    view.target = box.middle();
}

/// Where a drag of the mouse moves things by as much as the pointer.
void pan(const Event& e, const State& state, View& view) {
    const Point ahead = way(view.position, view.target), right = unit(cross(ahead, view.up));
    const Point up = unit(cross(right, ahead));
    const SineCosine half = sincos_deg(0.5 * view.fov_deg);
    const double metres = 2 * length(ahead) * half.sine / half.cosine / state.height;
    shift(right, -metres * e.dx, view);
    shift(up, metres * e.dy, view);
}

void move_mouse(const Event& e, State& state) {
    if (state.slides) {
        if (!state.has_sun) return;
        state.view.day_share = held(double(e.x) / std::max(state.width - 1, 1), 0, 1);
        if (state.sun_at)
            state.sun_at(state.view.day_share, state.view);
        else
            set_day(state.view.day_share, state.view);
        state.sun_moved = true;
        return;
    }
    if (state.held == Button::kNone) return;
    if (state.held == Button::kLeft) pan(e, state, state.view);
    if (state.held == Button::kMiddle) turn(kTurnDegrees * e.dx, -kTurnDegrees * e.dy, state.view);
    if (state.held == Button::kRight)
        revolve(kTurnDegrees * e.dx, kTurnDegrees * e.dy, state.box, state.view);
    state.moved = true;
}

void press(const Event& e, State& state) {
    state.slides = e.button == Button::kLeft && e.y >= state.height - kSliderHeight;
    state.held = state.slides ? Button::kNone : e.button;
    if (state.slides) move_mouse(e, state);
}

void walk(Key key, State& state) {
    View& view = state.view;
    const Point ahead = way(view.position, view.target);
    const double step = kStep * std::max(length(ahead), 0.02 * state.box.radius());
    const Point right = unit(cross(ahead, view.up));
    if (key == Key::kW) shift(unit(ahead), step, view);
    if (key == Key::kS) shift(unit(ahead), -step, view);
    if (key == Key::kD) shift(right, step, view);
    if (key == Key::kA) shift(right, -step, view);
    if (key == Key::kQ) shift({0, 0, 1}, step, view);
    if (key == Key::kZ) shift({0, 0, 1}, -step, view);
    state.moved = true;
}

void move_sun(double up, bool around, State& state) {
    if (!state.has_sun) return;
    if (around)
        state.view.azimuth_deg = std::fmod(state.view.azimuth_deg + 5 * up + 360, 360);
    else
        state.view.elevation_deg = held(state.view.elevation_deg + up, -90, 90);
    state.view.day_share = -1;
    state.sun_moved = true;
}

void press_key(const Event& e, State& state) {
    switch (e.key) {
        case Key::kF1:
            state.help = !state.help;
            break;
        case Key::kF3:
            frame(state.box, state.view), state.moved = true;
            break;
        case Key::kSpace:
            state.lit = !state.lit;
            break;
        case Key::kB:
            state.shown = Shown((int(state.shown) + 1) % 3);
            break;
        case Key::kP:
            state.screenshot = state.screenshot || e.control;
            break;
        case Key::kR:
            state.view = state.home, state.moved = state.sun_moved = true;
            break;
        case Key::kPageUp:
            move_sun(1, e.shift, state);
            break;
        case Key::kPageDown:
            move_sun(-1, e.shift, state);
            break;
        case Key::kEscape:
            state.ended = true;
            break;
        case Key::k1:
        case Key::k2:
        case Key::k3:
        case Key::k4:
        case Key::k5:
            state.method = 1 + int(e.key) - int(Key::k1);
            state.method_changed = true;
            break;
        default:
            walk(e.key, state);
            break;
    }
}

}  // namespace

Point Box::middle() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
}
double Box::radius() const { return std::max(0.5 * length(way(low, high)), 1e-3); }

const char* method_named(int number) {
    constexpr const char* kNames[kMethods] = {"collectors", "raymarch", "photon-grid",
                                              "optical-depth", "path"};
    return kNames[number - 1];
}

void set_day(double share, View& view) {
    const double s = held(share, 0, 1);
    view.azimuth_deg = 80 + 200 * s;
    view.elevation_deg = kLowestSun + (kHighestSun - kLowestSun) * sincos_deg(180 * s).sine;
}
double day_of(const View& view) { return held((view.azimuth_deg - 80) / 200, 0, 1); }

void apply(const Event& e, State& state) {
    switch (e.kind) {
        case EventKind::kKey:
            press_key(e, state);
            break;
        case EventKind::kPress:
            press(e, state);
            break;
        case EventKind::kRelease:
            state.held = Button::kNone, state.slides = false;
            break;
        case EventKind::kMove:
            move_mouse(e, state);
            break;
        case EventKind::kWheel:
            dolly(0.1 * e.wheel, state.view), state.moved = true;
            break;
        case EventKind::kResize:
            // A window may shrink to nothing; its picture does not.
            state.width = std::max(e.x, 16), state.height = std::max(e.y, 16);
            state.moved = true;
            break;
        case EventKind::kClose:
            state.ended = true;
            break;
        case EventKind::kNone:
            break;
    }
    if (!state.moved || state.view.position[2] >= state.lowest_m) return;
    // Not into the ground; the view keeps its direction.
    const double rise = state.lowest_m - state.view.position[2];
    shift({0, 0, 1}, rise, state.view);
}

std::vector<std::string> help_lines() {
    return {"F1 this help     F3 to the cloud     R where it began",
            "space light on and off     B colour, alpha, depth",
            "W A S D ahead and aside     Q Z up and down",
            "left button pans     middle turns the view",
            "right revolves about the cloud     wheel nearer, farther",
            "page up, down the sun     with shift around",
            "slider below: the day",
            "1 collectors 2 raymarch 3 photon-grid 4 optical-depth 5 path",
            "ctrl+P screenshot     esc ends"};
}

}  // namespace pileus::view
