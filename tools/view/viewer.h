// SPDX-License-Identifier: Apache-2.0
// The viewer: a session drawn into a window until the user has seen enough.
// in: a scene's text, a window -> out: pictures on it, screenshots as files.
// docs/view.md
#pragma once
#include <string>
#include <vector>

#include "tools/view/window.h"

namespace pileus::view {

struct Settings {
    std::string path;  ///< of a scene; empty: `text`
    std::string text;
    std::vector<std::string> sets;
    int width = 1280, height = 720, threads = 0;
    double fps = 60;
    int frames = 0;     ///< after so many it ends; 0: never
    bool hold = false;  ///< waits for the space bar before light is traced
    bool fixed_exposure = false;
    std::string screenshots = "view";  ///< files are this and a number
};

/// What a run was like, for tests and for a line at its end.
struct Outcome {
    int frames = 0;
    double first_lit_s = 0;
    int moving = 0;       ///< frames while things moved, without the first of each time
    double moving_s = 0;  ///< median from one to the next
    std::vector<std::string> screenshots;
};

/// kBadInput: the scene, or a method that it is not for; kIo: the window, a screenshot.
Status run(const Settings& settings, Window& window, Outcome& outcome);

}  // namespace pileus::view
