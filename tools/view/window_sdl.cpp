// SPDX-License-Identifier: Apache-2.0
// A window of SDL 2, which knows X11, Wayland and screens without a desktop.
// in: libSDL2-2.0.so.0, looked up while the program runs -> out: events, pixels on a screen.
// The only file that touches the library; its few functions are declared here. docs/view.md
#include "tools/view/window.h"

#ifdef PILEUS_WITH_SDL2
#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "src/base/dynamic_library.h"
#endif

namespace pileus::view {

#ifdef PILEUS_WITH_SDL2
namespace {

// Of SDL 2.0's stable interface.
constexpr std::uint32_t kInitVideo = 0x20, kResizable = 0x20;
constexpr int kCentred = 0x2FFF0000;
constexpr std::uint32_t kQuitEvent = 0x100, kWindowEvent = 0x200, kKeyDown = 0x300, kMotion = 0x400,
                        kButtonDown = 0x401, kButtonUp = 0x402, kWheelEvent = 0x403;
constexpr std::uint8_t kSizeChanged = 6;
constexpr int kShiftBits = 0x3, kControlBits = 0xC0;

/// The beginnings of SDL_Surface and SDL_PixelFormat.
struct PixelFormat {
    std::uint32_t format;
    void* palette;
    std::uint8_t bits, bytes, padding[2];
    std::uint32_t red, green, blue, alpha;
};
struct Surface {
    std::uint32_t flags;
    PixelFormat* format;
    int width, height, pitch;
    void* pixels;
};

/// An event as 56 bytes, whose parts lie where SDL has them.
struct RawEvent {
    alignas(8) unsigned char bytes[56];

    std::uint32_t word(int at) const {
        std::uint32_t v;
        std::memcpy(&v, bytes + at, sizeof v);
        return v;
    }
    int number(int at) const { return int(word(at)); }
};

struct Sdl {
    DynamicLibrary library{"libSDL2-2.0.so.0"};
    int (*init)(std::uint32_t);
    void (*quit)();
    const char* (*error)();
    const char* (*driver)();
    void* (*create_window)(const char*, int, int, int, int, std::uint32_t);
    void (*destroy_window)(void*);
    void (*window_size)(void*, int*, int*);
    void (*set_title)(void*, const char*);
    int (*set_hint)(const char*, const char*);
    Surface* (*window_surface)(void*);
    int (*update_surface)(void*);
    int (*poll)(RawEvent*);
    void (*delay)(std::uint32_t);
    std::uint64_t (*counter)();
    std::uint64_t (*frequency)();

    Sdl() {
        library.find("SDL_Init", init);
        library.find("SDL_Quit", quit);
        library.find("SDL_GetError", error);
        library.find("SDL_GetCurrentVideoDriver", driver);
        library.find("SDL_CreateWindow", create_window);
        library.find("SDL_DestroyWindow", destroy_window);
        library.find("SDL_GetWindowSize", window_size);
        library.find("SDL_SetWindowTitle", set_title);
        library.find("SDL_SetHint", set_hint);
        library.find("SDL_GetWindowSurface", window_surface);
        library.find("SDL_UpdateWindowSurface", update_surface);
        library.find("SDL_PollEvent", poll);
        library.find("SDL_Delay", delay);
        library.find("SDL_GetPerformanceCounter", counter);
        library.find("SDL_GetPerformanceFrequency", frequency);
    }
};

Key key_of(int symbol) {
    if (symbol >= '1' && symbol <= '5') return Key(int(Key::k1) + symbol - '1');
    switch (symbol) {
        case 27:
            return Key::kEscape;
        case ' ':
            return Key::kSpace;
        case 0x4000003A:
            return Key::kF1;
        case 0x4000003C:
            return Key::kF3;
        case 0x4000004B:
            return Key::kPageUp;
        case 0x4000004E:
            return Key::kPageDown;
        default:
            break;
    }
    return symbol >= 'a' && symbol <= 'z' ? key_named(std::string(1, char(symbol))) : Key::kNone;
}

/// Where a channel begins in a pixel's word.
int first_bit(std::uint32_t mask) {
    int bit = 0;
    while (bit < 24 && (mask >> bit & 1) == 0) ++bit;
    return bit;
}

class SdlWindow : public Window {
public:
    ~SdlWindow() override {
        if (window_ != nullptr) sdl_.destroy_window(window_);
        if (begun_) sdl_.quit();
    }

    Status open(int width, int height) {
        if (!sdl_.library.is_there())
            return Status::io(
                "view: libSDL2-2.0.so.0 is not installed (Debian: libsdl2-2.0-0), allowed: with "
                "it, or "
                "--script");
        if (!sdl_.library.is_whole()) return Status::io("view: SDL 2 lacks functions");
        // Pixels go to the display as they are: without a graphics card OpenGL would take longer to
        // show a picture than we do to make it.
        sdl_.set_hint("SDL_FRAMEBUFFER_ACCELERATION", "0");
        if (sdl_.init(kInitVideo) != 0) return fault("no display");
        begun_ = true;
        // SDL takes a screen that nobody sees for better than none; only who names it wants it.
        const char* driver = sdl_.driver();
        if (std::getenv("SDL_VIDEODRIVER") == nullptr &&
            (driver == nullptr || std::strcmp(driver, "offscreen") == 0 ||
             std::strcmp(driver, "dummy") == 0))
            return Status::io(
                "view: no display, allowed: X11, Wayland or KMS (DISPLAY, WAYLAND_DISPLAY), or "
                "--script");
        window_ = sdl_.create_window("pileus", kCentred, kCentred, width, height, kResizable);
        if (window_ == nullptr) return fault("no window");
        start_ = sdl_.counter();
        return Status::ok();
    }

    bool poll(Event& event) override {
        RawEvent raw;
        while (take(raw))
            if (translate(raw, event)) return true;
        return false;
    }
    /// Not by SDL_WaitEventTimeout: on X11 what it wakes up by may reach a window that has just
    /// been closed, which ends the program.
    void wait(double seconds) override {
        constexpr std::uint32_t kPieceMs = 4;
        for (double left_ms = 1000 * seconds; !has_next_ && left_ms > 0; left_ms -= kPieceMs) {
            has_next_ = sdl_.poll(&next_) != 0;
            if (!has_next_) sdl_.delay(kPieceMs);
        }
    }
    double seconds() override { return double(sdl_.counter() - start_) / double(sdl_.frequency()); }
    void size(int& width, int& height) override { sdl_.window_size(window_, &width, &height); }
    void set_title(const std::string& title) override { sdl_.set_title(window_, title.c_str()); }

    Status show(const std::uint8_t* pixels, int width, int height) override {
        const Surface* to = sdl_.window_surface(window_);
        if (to == nullptr) return fault("the picture cannot be shown");
        if (to->format->bytes != 4)
            return Status::io("view: a display of fewer than 24 bits a pixel, allowed: 24 or 32");
        // A window that has just changed its size shows the part that both have.
        const int columns = std::min(width, to->width), rows = std::min(height, to->height);
        const int red = first_bit(to->format->red), green = first_bit(to->format->green),
                  blue = first_bit(to->format->blue);
        for (int y = 0; y < rows; ++y) {
            const std::uint8_t* from = pixels + 4 * std::size_t(y) * std::size_t(width);
            auto* line = static_cast<unsigned char*>(to->pixels) + std::ptrdiff_t(y) * to->pitch;
            for (int x = 0; x < columns; ++x, from += 4, line += 4) {
                const std::uint32_t v = std::uint32_t(from[0]) << red |
                                        std::uint32_t(from[1]) << green |
                                        std::uint32_t(from[2]) << blue;
                std::memcpy(line, &v, sizeof v);
            }
        }
        return sdl_.update_surface(window_) == 0 ? Status::ok()
                                                 : fault("the picture cannot be shown");
    }

private:
    /// The next event, the one that ended a wait first.
    bool take(RawEvent& raw) {
        if (!has_next_) return sdl_.poll(&raw) != 0;
        raw = next_;
        has_next_ = false;
        return true;
    }

    Status fault(const char* what) {
        return Status::io(std::string("view: ") + what + ": " + sdl_.error());
    }

    bool translate(const RawEvent& raw, Event& e) {
        e = Event{};
        switch (raw.word(0)) {
            case kQuitEvent:
                e.kind = EventKind::kClose;
                return true;
            case kWindowEvent:
                if (raw.bytes[12] != kSizeChanged) return false;
                e.kind = EventKind::kResize;
                e.x = raw.number(16), e.y = raw.number(20);
                return true;
            case kKeyDown: {
                std::uint16_t held;
                std::memcpy(&held, raw.bytes + 24, sizeof held);
                e.kind = EventKind::kKey;
                e.key = key_of(raw.number(20));
                e.shift = (held & kShiftBits) != 0;
                e.control = (held & kControlBits) != 0;
                return e.key != Key::kNone;
            }
            case kMotion:
                e.kind = EventKind::kMove;
                e.x = raw.number(20), e.y = raw.number(24);
                e.dx = raw.number(28), e.dy = raw.number(32);
                return true;
            case kButtonDown:
            case kButtonUp:
                e.kind = raw.word(0) == kButtonDown ? EventKind::kPress : EventKind::kRelease;
                e.button = raw.bytes[16] == 1   ? Button::kLeft
                           : raw.bytes[16] == 2 ? Button::kMiddle
                           : raw.bytes[16] == 3 ? Button::kRight
                                                : Button::kNone;
                e.x = raw.number(20), e.y = raw.number(24);
                return e.button != Button::kNone;
            case kWheelEvent:
                e.kind = EventKind::kWheel;
                e.wheel = raw.number(20);
                return e.wheel != 0;
            default:
                return false;
        }
    }

    Sdl sdl_;
    void* window_ = nullptr;
    bool begun_ = false;
    RawEvent next_;
    bool has_next_ = false;
    std::uint64_t start_ = 0;
};

}  // namespace

Status open_sdl_window(int width, int height, std::unique_ptr<Window>& window) {
    auto opened = std::make_unique<SdlWindow>();
    PILEUS_TRY(opened->open(width, height));
    window = std::move(opened);
    return Status::ok();
}
#else
Status open_sdl_window(int, int, std::unique_ptr<Window>&) {
    return Status::io(
        "view: this build has no SDL 2, allowed: one with PILEUS_SDL2=ON, or --script");
}
#endif

}  // namespace pileus::view
