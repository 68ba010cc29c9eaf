// SPDX-License-Identifier: Apache-2.0
// Fuzz target: scene text.
// in: bytes as a scene file -> out: a checked scene, or lines that all name the file and a place.
// docs/scene.md, section Messages
#include "src/scene/read_scene.h"
#include "tests/fuzz/target.h"

int fuzz::scene(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    pileus::Scene scene;
    const pileus::Status status = pileus::read_scene_text(text, "s.toml", "", {}, scene);
    if (!status) {
        fuzz::check_fault(status, "s.toml:", false);
        return 0;
    }
    fuzz::require(scene.text == text, "a scene keeps its text");
    fuzz::require(scene.camera.resolution[0] >= 1 && scene.camera.resolution[1] >= 1,
                  "a checked scene has pixels");
    return 0;
}
