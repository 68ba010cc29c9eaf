// SPDX-License-Identifier: Apache-2.0
// Fuzz target: options --set KEY=VALUE.
// in: up to eight options, parted by zero bytes -> out: a scene that its own text makes again, or
// lines that name the option or a place of the file. docs/scene.md, section Overrides
#include <algorithm>

#include "src/scene/read_scene.h"
#include "tests/fuzz/target.h"
#include "tests/support/keys_text.h"

namespace {

using namespace pileus;

const std::string kScene =
    "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n"
    "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\n"
    "extinction_per_m = 1\nphase = { type = \"henyey-greenstein\", g = 0.5 }\n";

bool opens(const std::string& text, std::size_t at, const std::string& with) {
    return text.compare(at, with.size(), with) == 0;
}

void check_lines(const Status& status) {
    fuzz::check_fault(status, "", false);
    for (std::size_t at = 0; at < status.message.size();) {
        fuzz::require(opens(status.message, at, "--set ") || opens(status.message, at, "s.toml:"),
                      "a line names an option or a place of the file");
        const std::size_t end = status.message.find('\n', at);
        at = end == std::string::npos ? status.message.size() : end + 1;
    }
}

/// A picture stores the text: it must say what was set, and be a scene by itself.
void check_text(const Scene& scene, const std::vector<std::string>& options) {
    std::string text = kScene;
    for (const std::string& option : options) text += "\n# --set " + option;
    fuzz::require(scene.text == text, "the text tells every option");
    Scene plain, bare;
    fuzz::require(bool(read_scene_text(scene.text, "s.toml", "", {}, plain)),
                  "the text with its options as comments is a scene");
    fuzz::require(bool(read_scene_text(kScene, "s.toml", "", {}, bare)), "so is it without");
    fuzz::require(dump_scene(plain) == dump_scene(bare), "comments set nothing");
}

/// The options out of the text's comments make the same scene again.
void check_again(const Scene& scene, std::size_t count) {
    std::vector<std::string> options;
    const std::string mark = "\n# --set ";
    for (std::size_t at = kScene.size(); at < scene.text.size();) {
        fuzz::require(opens(scene.text, at, mark), "each option has a line of its own");
        const std::size_t begin = at + mark.size();
        at = std::min(scene.text.find('\n', begin), scene.text.size());
        options.push_back(scene.text.substr(begin, at - begin));
    }
    fuzz::require(options.size() == count, "no option is lost or doubled");
    Scene again;
    fuzz::require(bool(read_scene_text(kScene, "s.toml", "", options, again)),
                  "the options of the text are sound");
    fuzz::require(dump_scene(again) == dump_scene(scene), "they make the same scene");
}

}  // namespace

int fuzz::overrides(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMax = 8;
    std::vector<std::string> options(1);
    for (std::size_t i = 0; i < size; ++i) {
        if (data[i] != 0)
            options.back() += char(data[i]);
        else if (options.size() < kMax)
            options.emplace_back();
    }
    Scene scene;
    const Status status = read_scene_text(kScene, "s.toml", "", options, scene);
    if (!status) {
        check_lines(status);
        return 0;
    }
    fuzz::require(scene.camera.resolution[0] >= 1 && scene.camera.resolution[1] >= 1,
                  "a checked scene has pixels");
    fuzz::require(!scene.media.empty() && scene.media.size() <= 64, "1 to 64 media");
    check_text(scene, options);
    check_again(scene, options.size());
    return 0;
}
