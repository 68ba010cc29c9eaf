// SPDX-License-Identifier: Apache-2.0
// A window in memory, for tests and demonstrations.
// in: text -> out: events between the frames that are shown.
// docs/view.md, "Scripts"
#include <deque>
#include <sstream>

#include "tools/view/window.h"

namespace pileus::view {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;

struct Step {
    Event event;
    int frames = 0;  ///< that are shown before the next step; of events 0
};

class ScriptWindow : public Window {
public:
    ScriptWindow(std::deque<Step> steps, int width, int height)
        : steps_(std::move(steps)), width_(width), height_(height) {}

    bool poll(Event& event) override {
        if (steps_.empty()) {
            event = Event{};
            event.kind = EventKind::kClose;
            return true;
        }
        if (steps_.front().frames > 0) return false;
        event = steps_.front().event;
        if (event.kind == EventKind::kResize) width_ = event.x, height_ = event.y;
        steps_.pop_front();
        return true;
    }
    void wait(double) override { pass(); }
    Status show(const std::uint8_t*, int, int) override {
        pass();
        return Status::ok();
    }
    double seconds() override { return frames_ * kFrameSeconds; }
    void size(int& width, int& height) override { width = width_, height = height_; }

private:
    void pass() {
        ++frames_;
        if (!steps_.empty() && steps_.front().frames > 0 && --steps_.front().frames == 0)
            steps_.pop_front();
    }

    std::deque<Step> steps_;
    int width_, height_, frames_ = 0;
};

Button button_named(const std::string& name) {
    return name == "left"     ? Button::kLeft
           : name == "middle" ? Button::kMiddle
           : name == "right"  ? Button::kRight
                              : Button::kNone;
}

/// One line without its comment; false: it is none.
bool read_line(std::istringstream& words, const std::string& verb, Step& step) {
    Event& e = step.event;
    std::string name;
    if (verb == "frame") {
        step.frames = 1;
        return words.eof() || (words >> std::ws).eof() ||
               ((words >> step.frames) && step.frames > 0 && step.frames <= 1000000);
    }
    if (verb == "key") {
        e.kind = EventKind::kKey;
        words >> name;
        e.key = key_named(name);
        while (words >> name) {
            if (name == "shift")
                e.shift = true;
            else if (name == "control")
                e.control = true;
            else
                return false;
        }
        return e.key != Key::kNone;
    }
    if (verb == "press" || verb == "release") {
        e.kind = verb == "press" ? EventKind::kPress : EventKind::kRelease;
        words >> name >> e.x >> e.y;
        e.button = button_named(name);
        return !words.fail() && e.button != Button::kNone;
    }
    if (verb == "move") {
        e.kind = EventKind::kMove;
        return bool(words >> e.x >> e.y >> e.dx >> e.dy);
    }
    if (verb == "wheel") {
        e.kind = EventKind::kWheel;
        return bool(words >> e.wheel);
    }
    if (verb == "resize") {
        e.kind = EventKind::kResize;
        return (words >> e.x >> e.y) && e.x > 0 && e.y > 0 && e.x <= 16384 && e.y <= 16384;
    }
    e.kind = EventKind::kClose;
    return verb == "close";
}

}  // namespace

Key key_named(const std::string& name) {
    constexpr struct {
        const char* name;
        Key key;
    } kKeys[] = {{"f1", Key::kF1},
                 {"f3", Key::kF3},
                 {"space", Key::kSpace},
                 {"b", Key::kB},
                 {"p", Key::kP},
                 {"r", Key::kR},
                 {"w", Key::kW},
                 {"a", Key::kA},
                 {"s", Key::kS},
                 {"d", Key::kD},
                 {"q", Key::kQ},
                 {"z", Key::kZ},
                 {"page_up", Key::kPageUp},
                 {"page_down", Key::kPageDown},
                 {"escape", Key::kEscape},
                 {"1", Key::k1},
                 {"2", Key::k2},
                 {"3", Key::k3},
                 {"4", Key::k4},
                 {"5", Key::k5}};
    for (const auto& known : kKeys)
        if (name == known.name) return known.key;
    return Key::kNone;
}

Status open_script_window(const std::string& script, int width, int height,
                          std::unique_ptr<Window>& window) {
    std::deque<Step> steps;
    std::istringstream lines(script);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string verb;
        if (!(words >> verb)) continue;
        Step step;
        if (!read_line(words, verb, step))
            return Status::bad_input("--script: line " + std::to_string(number) +
                                     ": no event, allowed: key, press, release, move, wheel, "
                                     "resize, close, frame, as docs/view.md has them");
        steps.push_back(step);
    }
    window = std::make_unique<ScriptWindow>(std::move(steps), width, height);
    return Status::ok();
}

}  // namespace pileus::view
