// SPDX-License-Identifier: Apache-2.0
// The viewer by scripts: what keys and mice do, frames, screenshots, faults.
// in: scripts, a small scene -> out: states, files.
// docs/view.md
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "tests/support/air_scene.h"
#include "tools/view/controls.h"
#include "tools/view/noise.h"
#include "tools/view/overlay.h"
#include "tools/view/smaller.h"
#include "tools/view/viewer.h"

using namespace pileus::view;
using pileus::Code;
using pileus::Status;

namespace {

Outcome play(const std::string& script, Settings settings = {}) {
    std::unique_ptr<Window> window;
    if (settings.text.empty()) settings.text = render_test::kSmallCumulus;
    settings.sets.push_back("output.layers=[\"radiance\"]");
    settings.width = 64, settings.height = 36;
    settings.threads = 2;
    REQUIRE(open_script_window(script, settings.width, settings.height, window));
    Outcome out;
    const Status status = run(settings, *window, out);
    REQUIRE_MESSAGE(status, status.message);
    return out;
}

State at_cloud() {
    State s;
    s.box = {{-768, -768, 512}, {768, 768, 1536}};
    s.view.position = {0, -4000, 256};
    s.view.target = {0, 0, 1024};
    s.home = s.view;
    s.lowest_m = 0.5;
    return s;
}

void key(State& s, Key k, bool shift = false, bool control = false) {
    Event e;
    e.kind = EventKind::kKey;
    e.key = k, e.shift = shift, e.control = control;
    apply(e, s);
}
void drag(State& s, Button button, int dx, int dy) {
    Event e;
    e.kind = EventKind::kPress, e.button = button, e.x = 100, e.y = 100;
    apply(e, s);
    e.kind = EventKind::kMove, e.dx = dx, e.dy = dy;
    apply(e, s);
    e.kind = EventKind::kRelease;
    apply(e, s);
}
double distance(const Point& a, const Point& b) {
    return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                     (a[2] - b[2]) * (a[2] - b[2]));
}

}  // namespace

TEST_CASE("view: the right button revolves at one distance and looks at the cloud") {
    State s = at_cloud();
    const double before = distance(s.view.position, s.box.middle());
    for (int i = 0; i < 30; ++i) drag(s, Button::kRight, 60, 7);
    CHECK(distance(s.view.position, s.box.middle()) == doctest::Approx(before).epsilon(1e-9));
    CHECK(s.view.target == s.box.middle());
    CHECK(s.moved);
    // Not over the top: up stays up.
    for (int i = 0; i < 30; ++i) drag(s, Button::kRight, 0, 500);
    CHECK(s.view.position[2] < s.box.middle()[2] + before);
    CHECK(std::isfinite(s.view.position[0]));
}

TEST_CASE("view: the middle button turns, the left one pans, the wheel goes nearer") {
    State s = at_cloud();
    const Point eye = s.view.position;
    drag(s, Button::kMiddle, 100, 0);
    CHECK(s.view.position == eye);
    CHECK(s.view.target[0] > 0);
    s = at_cloud();
    drag(s, Button::kLeft, 0, 50);
    CHECK(s.view.position[2] > eye[2]);
    CHECK(distance(s.view.position, s.view.target) == doctest::Approx(distance(eye, {0, 0, 1024})));
    s = at_cloud();
    Event wheel;
    wheel.kind = EventKind::kWheel, wheel.wheel = 1000;
    apply(wheel, s);
    // Never through the target.
    CHECK(distance(s.view.position, s.view.target) > 0);
}

TEST_CASE("view: keys walk, never into the ground; F3 frames, R goes home") {
    State s = at_cloud();
    for (int i = 0; i < 1000; ++i) key(s, Key::kZ);
    CHECK(s.view.position[2] == doctest::Approx(0.5));
    key(s, Key::kF3);
    CHECK(s.view.target == s.box.middle());
    key(s, Key::kR);
    CHECK(s.view.position == s.home.position);
    for (const Key k : {Key::kW, Key::kA, Key::kS, Key::kD, Key::kQ}) {
        State t = at_cloud();
        key(t, k);
        CHECK(distance(t.view.position, s.home.position) > 1);
    }
    key(s, Key::kP);
    CHECK_FALSE(s.screenshot);
    key(s, Key::kP, false, true);
    CHECK(s.screenshot);
    key(s, Key::k3);
    CHECK(s.method == 3);
    key(s, Key::kEscape);
    CHECK(s.ended);
}

TEST_CASE("view: the sun by keys and by the slider") {
    State s = at_cloud();
    for (int i = 0; i < 200; ++i) key(s, Key::kPageUp);
    CHECK(s.view.elevation_deg == 90);
    for (int i = 0; i < 100; ++i) key(s, Key::kPageDown, true);
    CHECK(s.view.azimuth_deg >= 0);
    CHECK(s.view.azimuth_deg < 360);
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        set_day(share, s.view);
        CHECK(day_of(s.view) == doctest::Approx(share));
    }
    CHECK(s.view.elevation_deg == doctest::Approx(-6));
    Event press;
    press.kind = EventKind::kPress, press.button = Button::kLeft, press.x = 640, press.y = 715;
    s.sun_moved = s.moved = false;
    apply(press, s);
    CHECK(s.sun_moved);
    CHECK_FALSE(s.moved);
    CHECK(s.view.elevation_deg == doctest::Approx(66).epsilon(0.01));
    State dark = at_cloud();
    dark.has_sun = false;
    key(dark, Key::kPageUp);
    CHECK_FALSE(dark.sun_moved);
}

TEST_CASE("view: the slider of a scene with a clock, and what takes the sun from it") {
    State s = at_cloud();
    double asked = -1;
    s.sun_at = [&](double share, View& view) { asked = share, view.elevation_deg = 12; };
    Event press;
    press.kind = EventKind::kPress, press.button = Button::kLeft, press.y = 719;
    for (const int x : {0, 1279}) {
        press.x = x;
        apply(press, s);
        CHECK(asked == x / 1279.0);
        CHECK(s.view.day_share == asked);
        CHECK(s.view.elevation_deg == 12);
    }
    // Dragged over the edge it stays there.
    Event move;
    move.kind = EventKind::kMove, move.x = 5000, move.y = 3;
    apply(move, s);
    CHECK(asked == 1);
    key(s, Key::kPageUp);
    CHECK(s.view.day_share < 0);
}

TEST_CASE("view: the error that is shown is that of a mean of samples") {
    // Pictures of known noise: the mean of n values, each 2 or 0, has the error 1 / sqrt(n).
    Noise noise;
    const std::size_t pixels = 40000;
    std::vector<float> sum(4 * pixels, 0), mean;
    std::uint32_t state = 1;
    for (std::uint64_t n = 1; n <= 64; ++n) {
        for (float& v : sum) {
            state = state * 1664525u + 1013904223u;
            v += (state >> 31) != 0 ? 2.0f : 0.0f;
        }
        if (!noise.wants(n, 64)) continue;
        mean = sum;
        for (float& v : mean) v /= float(n);
        noise.add(n, mean);
        CHECK(noise.known() == (n > 1));
        // 120 000 numbers: their spread is known to 0.2 %.
        if (n > 1) CHECK(noise.error() == doctest::Approx(1 / std::sqrt(double(n))).epsilon(0.02));
    }
    noise.begin();
    CHECK_FALSE(noise.known());
    // A full ring never doubles.
    CHECK_FALSE(noise.wants(8, 8));
}

TEST_CASE("view: pictures become smaller where less work does not do, and whole again") {
    const double target = 1.0 / 60;
    Smaller smaller;
    CHECK(smaller.choose(0, target, 0) == 1);
    for (int i = 0; i < 1000; ++i) REQUIRE(smaller.choose(target, target, 3) == 1);
    int frames = 1;
    while (smaller.choose(1.5 * target, target, 7) == 1) ++frames;
    // The governor's own walk is no longer.
    CHECK(frames == 20);
    for (int i = 0; i < 1000; ++i) REQUIRE(smaller.choose(0.5 * target, target, 0) == 2);
    // Less work than the scene's is no reason for more pixels.
    for (int i = 0; i < 1000; ++i) REQUIRE(smaller.choose(0.1 * target, target, 1) == 2);
    for (int i = 0; i < 4; ++i) smaller.choose(9 * target, target, 7);
    CHECK(smaller.choose(9 * target, target, 7) == 4);
    for (int i = 0; i < 1000; ++i) REQUIRE(smaller.choose(9 * target, target, 7) == 4);
    for (int i = 0; i < 60; ++i) smaller.choose(0.1 * target, target, 0);
    CHECK(smaller.choose(0.3 * target, target, 0) == 1);
}

TEST_CASE(
    "view: pictures enlarged are linear between their pixels, and as they were at their rim") {
    std::vector<std::uint8_t> large;
    for (const int size : {1, 2, 7}) {
        std::vector<std::uint8_t> even(4 * std::size_t(size) * std::size_t(size), 201);
        enlarge(even, size, size, 2 * size + 1, 3 * size, large);
        REQUIRE(large.size() == 4 * std::size_t(2 * size + 1) * std::size_t(3 * size));
        for (const std::uint8_t v : large) REQUIRE(v == 201);
    }
    // 40 and 80: at a quarter, three quarters, and beyond both middles.
    enlarge({40, 40, 40, 255, 80, 80, 80, 255}, 2, 1, 4, 1, large);
    const int wanted[] = {40, 50, 70, 80};
    for (int x = 0; x < 4; ++x) CHECK(int(large[std::size_t(4 * x)]) == wanted[x]);
    // The same size gives the same bytes.
    const std::vector<std::uint8_t> same{1, 2, 3, 4, 250, 251, 252, 253};
    enlarge(same, 1, 2, 1, 2, large);
    CHECK(large == same);
}

TEST_CASE("view: a script is played to its end, resized, closed in mid-frame") {
    CHECK(play("frame 3\n").frames == 3);
    CHECK(play("").frames == 0);
    CHECK(play("frame\nresize 1 1\nframe 2\nresize 90 50\nframe\n").frames == 4);
    CHECK(play("frame 2\npress right 5 5\nmove 9 9 4 4\nclose\nframe 100\n").frames == 2);
    Settings three;
    three.frames = 3;
    CHECK(play("frame 100\n", three).frames == 3);
    // At rest with all its light, no frame is drawn.
    Settings fixed;
    fixed.fixed_exposure = true;
    fixed.sets = {"method.name=raymarch"};
    CHECK(play("frame 200\n", fixed).frames < 10);
}

TEST_CASE("view: every method, and those that a scene is not for") {
    Settings s;
    s.fixed_exposure = true;
    const Outcome out = play(
        "frame\nkey 1\nframe 2\nkey 2\nframe 2\nkey 3\nframe 2\nkey 4\nframe 2\nkey 5\nframe 2\n",
        s);
    CHECK(out.frames == 11);
    CHECK(out.first_lit_s > 0);
}

TEST_CASE("view: places that no camera may have leave the picture as it was, at any size") {
    // A camera that cells are lit towards stands; the window changes, and things move so long that
    // pictures would become smaller.
    const std::string moves =
        "frame\nresize 90 50\nkey w\nframe 2\nresize 20 18\nkey w\nframe 2\nkey p control\nframe\n"
        "key 2\nresize 30 20\nframe 2\nkey p control\nframe\n";
    Settings fixed;
    fixed.fixed_exposure = true;
    fixed.screenshots = "/tmp/pileus_view_test_" + std::to_string(::getpid());
    fixed.sets = {"collectors.closure=\"camera\""};
    const Outcome out = play(moves, fixed);
    CHECK(out.frames == 9);
    REQUIRE(out.screenshots.size() == 2);
    const std::string wanted[] = {{'\0', '\0', '\0', 64, '\0', '\0', '\0', 36},
                                  {'\0', '\0', '\0', 30, '\0', '\0', '\0', 20}};
    for (std::size_t i = 0; i < 2; ++i) {
        // Width and height of a PNG.
        std::string head(24, ' ');
        std::ifstream(out.screenshots[i], std::ios::binary).read(&head[0], 24);
        CHECK(head.substr(16) == wanted[i]);
        std::remove(out.screenshots[i].c_str());
    }
    // Above the air over a level ground.
    std::string up;
    for (int i = 0; i < 400; ++i) up += "wheel -9\nframe\n";
    Settings air = fixed;
    air.text = air_test::in_air();
    air.sets = {"method.name=raymarch"};
    air.fps = 1000;
    CHECK(play(up + "key q\nframe\nresize 70 40\nkey q\nframe 3\n", air).frames >= 400);
}

TEST_CASE("view: screenshots take the next free name") {
    Settings s;
    s.screenshots = "/tmp/pileus_view_test_" + std::to_string(::getpid());
    const std::string taken = s.screenshots + "_0001.png";
    std::ofstream(taken) << "mine";
    const Outcome out = play("frame\nkey p control\nframe 2\nkey p control\nframe\n", s);
    REQUIRE(out.screenshots.size() == 2);
    CHECK(out.screenshots[0] == s.screenshots + "_0002.png");
    std::string kept;
    std::ifstream(taken) >> kept;
    CHECK(kept == "mine");
    for (const std::string& file : out.screenshots) {
        char magic[4] = {};
        std::ifstream(file, std::ios::binary).read(magic, 4);
        CHECK(std::string(magic + 1, 3) == "PNG");
        std::remove(file.c_str());
    }
    std::remove(taken.c_str());
}

TEST_CASE("view: bad scripts and scenes are one line") {
    std::unique_ptr<Window> window;
    for (const char* script : {"jump\n", "key\n", "key x9\n", "key w alt\n", "press 1 2\n",
                               "move 1 2\n", "wheel\n", "resize 0 5\n", "frame -1\n"}) {
        const Status status = open_script_window(script, 64, 36, window);
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find("line 1") != std::string::npos);
    }
    REQUIRE(open_script_window("frame\n", 64, 36, window));
    Settings s;
    s.path = "/nowhere/none.toml";
    Outcome out;
    CHECK_FALSE(run(s, *window, out));
}

TEST_CASE("view: what is drawn over a picture stays within it") {
    for (const int size : {1, 7, 30, 300}) {
        std::vector<std::uint8_t> pixels(4 * std::size_t(size) * std::size_t(size), 90);
        const Canvas canvas{pixels.data(), size, size};
        draw_text(canvas, -3, 2, 2, {"ABC xyz 0123456789", "~"});
        draw_times(canvas, 5, 5, 100, 40, std::deque<double>(500, 0.5), 1.0 / 60);
        draw_slider(canvas, 24, 1);
    }
    std::vector<std::uint8_t> one(4 * 40 * 20, 0);
    draw_text({one.data(), 40, 20}, 4, 4, 1, {"I"});
    // The stroke of the letter.
    CHECK(one[4 * (5 * 40 + 6)] == 235);
}
