// SPDX-License-Identifier: Apache-2.0
// Rows of the key table for what is written, and for the tables of later methods.
// in: checked TOML values -> out: fields of Scene, OutputSettings, Animation.
// docs/scene.md.
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

const KeyRow kRows[] = {
    plain_key(KeyKind::kTable, "optical-depth", "", "settings of a later method", nullptr),
    plain_key(KeyKind::kTable, "photon-grid", "", "settings of a later method", nullptr),
    plain_key(KeyKind::kTable, "particles", "", "settings of a later method", nullptr),

    plain_key(KeyKind::kTexts, "output.files", "[]",
              "pictures to write, relative to the scene's folder; names end in .exr, .png or "
              ".pfm",
              [](const Node& n, KeyTarget t) {
                  for (const Node& file : n.children) t.scene.output.files.push_back(file.text);
              }),
    plain_key(KeyKind::kText, "output.report", "\"\"",
              "JSON report to write, relative to the scene's folder; empty: none",
              [](const Node& n, KeyTarget t) { t.scene.output.report = n.text; }),
    choice_key(KeyKind::kTexts, "output.layers", "[\"radiance\", \"alpha\"]",
               "radiance|alpha|depth|error|cloud|optical_depth|transmittance|light|order", nullptr,
               "layers of the picture; radiance and alpha are always there",
               [](const Node& n, KeyTarget t) {
                   t.scene.output.layer_depth = texts_hold(n, "depth");
                   t.scene.output.layer_error = texts_hold(n, "error");
                   t.scene.output.layer_cloud = texts_hold(n, "cloud");
                   t.scene.output.layer_optical_depth = texts_hold(n, "optical_depth");
                   t.scene.output.layer_transmittance = texts_hold(n, "transmittance");
                   t.scene.output.layer_light = texts_hold(n, "light");
                   t.scene.output.layer_order = texts_hold(n, "order");
               }),

    range_key(KeyKind::kInteger, "animation.frames", "", "1", {1, 1000000, false, false},
              "number of pictures",
              [](const Node& n, KeyTarget t) {
                  t.scene.animation.frames = static_cast<int>(integer_of(n));
              }),
    range_key(KeyKind::kNumber2, "animation.camera_orbit_deg", "deg", "",
              {-36000, 36000, false, false},
              "first and last angle by which the camera has turned about its target",
              [](const Node& n, KeyTarget t) {
                  t.scene.animation.camera_orbit_deg = number2_of(n);
                  t.scene.animation.moves_camera = true;
              }),
    range_key(KeyKind::kNumber2, "animation.sun_elevation_deg", "deg", "", {-90, 90, false, false},
              "first and last elevation of the sun; needs a sun",
              [](const Node& n, KeyTarget t) {
                  t.scene.animation.sun_elevation_deg = number2_of(n);
                  t.scene.animation.moves_sun = true;
              }),
};

}  // namespace

Span<const KeyRow> output_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
