// SPDX-License-Identifier: Apache-2.0
// The viewer's window on a real X server without a screen: mouse, keys, closing, no display.
// in: xdotool's events in Xvfb -> out: exit statuses, screenshots.
// Left out with a line where Xvfb, xdotool or SDL 2 is missing. docs/view.md
#include "tests/cli/run_program.h"

using namespace pileus;
using test::Outcome;
using test::ProgramFolder;

namespace {

bool can_show() {
    const ProgramFolder folder;
    if (std::system("command -v Xvfb xdotool >/dev/null 2>&1") != 0 ||
        folder.run("view --help").exit_status != 0) {
        MESSAGE("skipped: no Xvfb or no xdotool here");
        return false;
    }
    const Outcome out = folder.run("view s.toml", "env -u WAYLAND_DISPLAY DISPLAY=:9999");
    if (out.errors.find("not installed") != std::string::npos ||
        out.errors.find("has no SDL 2") != std::string::npos) {
        MESSAGE("skipped: " << out.errors);
        return false;
    }
    return true;
}

/// Runs the viewer on an X server of its own; `events` is a shell script with $window.
Outcome show(const ProgramFolder& folder, const std::string& arguments, const std::string& events,
             const std::string& server = "") {
    folder.files().put(
        "session.sh",
        "Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp " + server +
            " 3>display 2>server.log &\n"
            "server=$!\n"
            "trap 'kill $server; wait $server 2>/dev/null' EXIT\n"
            "for i in $(seq 100); do [ -s display ] && break; sleep 0.1; done\n"
            "export DISPLAY=:$(cat display) SDL_VIDEODRIVER=x11\n"
            "unset WAYLAND_DISPLAY\n"
            // Takes a screenshot and waits for its file.
            "shot() { xdotool key ctrl+p; for i in $(seq 300); do [ -s $1 ] && break; sleep 0.1; "
            "done; }\n"
            // Libraries of the display keep memory to the end of the program.
            "export ASAN_OPTIONS=\"$ASAN_OPTIONS:detect_leaks=0\"\n"
            "\"$PILEUS_PROGRAM\" view s.toml --size 320x200 --threads 1 " +
            arguments +
            " 2>viewer.err &\n"
            "viewer=$!\n"
            "window=$(timeout 60 xdotool search --sync --onlyvisible --name '^pileus$' | tail -n "
            "1)\n"
            "timeout 10 xdotool windowfocus --sync $window\n" +
            // A picture of its own before the first event.
            "sleep 0.5\n" + events +
            "\nfor i in $(seq 300); do kill -0 $viewer 2>/dev/null || break; sleep 0.1; done\n"
            "kill -0 $viewer 2>/dev/null && kill $viewer && echo still there >&2\n"
            "wait $viewer\n"
            "echo status $?\n");
    // xdotool may complain of a window that has just gone: what counts is what the viewer says.
    Outcome out = folder.run("--version >/dev/null; sh session.sh");
    if (out.errors.find("still there") == std::string::npos)
        out.errors = folder.files().get("viewer.err");
    return out;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

}  // namespace

TEST_CASE("window: mouse and keys of an X server reach the view; screenshots show it") {
    if (!can_show()) return;
    for (const char* server : {"", "-extension MIT-SHM"}) {
        CAPTURE(server);
        const ProgramFolder folder;
        const Outcome out = show(folder, "--fixed-exposure",
                                 "shot view_0001.png\n"
                                 "xdotool mousemove --window $window 100 100 mousedown 3 "
                                 "mousemove --window $window 180 120 mouseup 3\n"
                                 "shot view_0002.png\n"
                                 "xdotool key r\n"
                                 "shot view_0003.png\n"
                                 "xdotool key F1 b b b Escape",
                                 server);
        CHECK_MESSAGE(out.output.find("status 0\n") != std::string::npos, out.output);
        CHECK_MESSAGE(out.errors.empty(), out.errors);
        CHECK(count_of(out.output, "screenshot view_") == 3);
        const std::string first = folder.files().get("view_0001.png");
        const std::string turned = folder.files().get("view_0002.png");
        const std::string back = folder.files().get("view_0003.png");
        REQUIRE_FALSE(first.empty());
        CHECK(first != turned);
        CHECK(turned != back);
    }
}

TEST_CASE("window: taken away in mid-frame, or with its server, it ends and loses nothing") {
    if (!can_show()) return;
    // X's library ends the program then; a picture that was taken before is whole.
    for (const char* end : {"xdotool windowclose $window", "kill $server"}) {
        CAPTURE(end);
        const ProgramFolder folder;
        const Outcome out = show(folder, "--set method.name=path",
                                 "shot view_0001.png\n"
                                 "xdotool key w w w\n"
                                 "xdotool mousemove --window $window 100 100 mousedown 1\n" +
                                     std::string(end));
        CHECK(out.errors.find("still there") == std::string::npos);
        const std::string kept = folder.files().get("view_0001.png");
        REQUIRE(kept.size() > 12);
        CHECK(kept.substr(1, 3) == "PNG");
        CHECK(kept.substr(kept.size() - 8, 4) == "IEND");
    }
}

TEST_CASE("window: no display is one line") {
    if (!can_show()) return;
    const ProgramFolder folder;
    // By SDL's choice of a driver, and by the user's. libwayland may have a line of its own.
    for (const char* driver : {"", "SDL_VIDEODRIVER=x11"}) {
        const Outcome out = folder.run(
            "view s.toml", std::string("env -u WAYLAND_DISPLAY DISPLAY=:9999 ") + driver);
        CHECK(out.exit_status != 0);
        CHECK(count_of(out.errors, "view: ") == 1);
        CHECK(folder.left().empty());
    }
}
