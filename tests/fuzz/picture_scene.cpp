// SPDX-License-Identifier: Apache-2.0
// Fuzz target: what a picture says of the run that made it.
// in: attributes of an .exr file, "NAME=TEXT" parted by zero bytes -> out: a scene's text and the
// options of a run, or lines that name attributes. docs/program.md, "A picture made again"
#include "tools/pileus/picture_scene.h"

#include "src/scene/read_scene.h"
#include "tests/fuzz/target.h"

namespace {

using namespace pileus;

/// As a picture's file holds them, those without a name as its scene.
Image image_of(const std::string& text) {
    Image image;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\0', at), text.size());
        const std::string part = text.substr(at, end - at);
        const std::size_t sign = part.find('=');
        const std::string name = sign == std::string::npos ? "" : part.substr(0, sign);
        const std::string value = sign == std::string::npos ? part : part.substr(sign + 1);
        if (name.empty() || name == "scene")
            image.scene_text = value;
        else if (name == "pixelHash")
            image.pixel_hash = value;
        else
            image.origin.emplace_back(name, value);
        at = end + 1;
    }
    return image;
}

void check_origin(const PictureScene& picture) {
    fuzz::require(picture.hash.size() == 16, "a picture has its hash");
    fuzz::require(picture.first_frame >= 0 && picture.first_frame <= picture.frame,
                  "its run began with it or before");
    fuzz::require(picture.seed >= 0, "seeds are not negative");
    fuzz::require(!picture.method.empty() && !picture.version.empty(), "it names its method");
    Scene scene;
    if (!read_scene_text(picture.text, "picture", picture.directory, picture.overrides, scene))
        return;
    int first = 0, last = 0;
    const Status frames = picture_frames(picture, scene, first, last);
    if (!frames) {
        fuzz::check_fault(frames, "picture.exr: ", true);
        return;
    }
    fuzz::require(first >= picture.first_frame && first <= last && last == picture.frame,
                  "frames are those of the run");
}

}  // namespace

int fuzz::picture_scene(const std::uint8_t* data, std::size_t size) {
    const Image image = image_of(std::string(reinterpret_cast<const char*>(data), size));
    PictureScene picture;
    const Status status = take_picture_scene("picture.exr", image, std::nullopt, picture);
    if (status)
        check_origin(picture);
    else
        fuzz::check_fault(status, "picture.exr: ", false);
    return 0;
}
