// SPDX-License-Identifier: Apache-2.0
// Fuzz target: the whole way from a scene to a picture, for scenes that are always valid.
// in: bytes that choose a scene -> out: finite light, balanced ledgers, no accident counted.
// docs/report.md, counters; docs/testing.md, section Fuzzing
#include "src/session/render.h"

#include "src/scene/read_scene.h"
#include "tests/fuzz/scene_maker.h"
#include "tests/fuzz/target.h"

namespace {

using namespace pileus;

constexpr float kMaxFloat = 3.402823466e38f;

void check_light(const Image& image) {
    for (const Channel& channel : image.channels) {
        // A depth that is never met is infinite; everything else is a finite amount of light.
        const bool depth = channel.name == "Z";
        for (const float v : channel.pixels.span()) {
            fuzz::require(v >= 0.0f, "no pixel is negative or not a number");
            fuzz::require(depth || v <= kMaxFloat, "no radiance is infinite");
        }
    }
}

void check_report(const Report& report) {
    for (const EnergyRow& row : report.photons.energy)
        fuzz::require(row.balance_quanta == 0, "emitted light is all accounted for");
    for (const auto& counter : report.counters) {
        const bool trouble = counter.first == "nan" || counter.first == "majorant_violations" ||
                             counter.first == "saturated" || counter.first == "nan_samples";
        fuzz::require(!trouble || counter.second == 0, "no accident is counted");
    }
}

}  // namespace

int fuzz::render(const std::uint8_t* data, std::size_t size) {
    const std::string text = fuzz::SceneMaker(data, size).text();
    Scene scene;
    const Status valid = read_scene_text(text, "s.toml", "", {}, scene);
    if (!valid) std::fprintf(stderr, "%s\n%s\n", text.c_str(), valid.message.c_str());
    fuzz::require(bool(valid), "the maker's scenes are valid");
    RenderOptions options;
    options.threads = 1;
    bool shown = false;
    const Status status = render(scene, options, [&](int, Image& image, Report& report) {
        shown = true;
        fuzz::check_picture(image, 64);
        check_light(image);
        check_report(report);
        return Status::ok();
    });
    // Cells lit towards a camera hold the phase function's peak, which its sums may have no room
    // for, and which is a delta at g = 1 or -1; nothing else may be refused.
    const bool refused =
        status.code == Code::kLimit || status.message.find("a lobe of g = ") != std::string::npos;
    const bool peak = refused && (scene.collectors.closure.camera ||
                                  scene.photon_grid.closure == GridClosure::kCamera);
    if (!status && !peak) std::fprintf(stderr, "%s\n%s\n", text.c_str(), status.message.c_str());
    fuzz::require(status ? shown : peak, "a valid scene is rendered");
    return 0;
}
