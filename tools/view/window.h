// SPDX-License-Identifier: Apache-2.0
// A window that shows pixels and hears of keys and mice, whatever draws it.
// in: pixels -> out: events.
// docs/view.md
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "src/base/status.h"

namespace pileus::view {

enum class Key {
    kNone,
    kF1,
    kF3,
    kSpace,
    kB,
    kP,
    kR,
    kW,
    kA,
    kS,
    kD,
    kQ,
    kZ,
    kPageUp,
    kPageDown,
    kEscape,
    k1,
    k2,
    k3,
    k4,
    k5
};
enum class Button { kNone, kLeft, kMiddle, kRight };
enum class EventKind { kNone, kKey, kPress, kRelease, kMove, kWheel, kResize, kClose };

struct Event {
    EventKind kind = EventKind::kNone;
    Key key = Key::kNone;
    bool shift = false, control = false;
    Button button = Button::kNone;
    int x = 0, y = 0;    ///< pixels from the top left; of a resize: the size
    int dx = 0, dy = 0;  ///< of a move
    int wheel = 0;       ///< notches, away from the user above 0
};

class Window {
public:
    virtual ~Window() = default;
    /// The next event; false: there is none now.
    virtual bool poll(Event& event) = 0;
    /// Waits for an event, at most so long.
    virtual void wait(double seconds) = 0;
    /// Four bytes a pixel, R G B A, rows from the top. kIo: it cannot be shown any more.
    virtual Status show(const std::uint8_t* pixels, int width, int height) = 0;
    /// Seconds since it was opened.
    virtual double seconds() = 0;
    virtual void size(int& width, int& height) = 0;
    virtual void set_title(const std::string&) {}
};

/// One of SDL 2, loaded now. kIo: no SDL, no display; a line says which.
Status open_sdl_window(int width, int height, std::unique_ptr<Window>& window);

/// One in memory that plays events from text; each frame takes a sixtieth of a second. Lines:
/// `key NAME [shift] [control]`, `press|release BUTTON X Y`, `move X Y DX DY`, `wheel N`,
/// `resize W H`, `close`, `frame [N]`: N frames are shown before what follows; `#` begins a
/// comment. kBadInput: a line that is none of these.
Status open_script_window(const std::string& script, int width, int height,
                          std::unique_ptr<Window>& window);

/// "w", "page_up", ...; kNone: no such key.
Key key_named(const std::string& name);

}  // namespace pileus::view
