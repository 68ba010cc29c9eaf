// SPDX-License-Identifier: Apache-2.0
// Keys of what is written, and of animations.
// in: checked values <-> out: fields of OutputSettings, Animation.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"
#include "src/scene/rows/layer_flags.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField output = field<&Scene::output, Members...>;
template <auto... Members>
constexpr KeyField animation = field<&Scene::animation, Members...>;

constexpr KeyField kLayers{KeyKind::kTexts,
                           [](const KeySource& s) {
                               std::vector<std::string> names{"radiance", "alpha"};
                               for (const LayerFlag& layer : kLayerFlags)
                                   if (s.scene.output.*layer.wanted) names.emplace_back(layer.name);
                               return node_of(names);
                           },
                           [](const KeyTarget& t, const Node& n) {
                               for (const LayerFlag& layer : kLayerFlags)
                                   t.scene.output.*layer.wanted = texts_hold(n, layer.name);
                           }};

constexpr KeyField kOrbit{KeyKind::kNumber2,
                          [](const KeySource& s) {
                              const Animation& a = s.scene.animation;
                              return a.moves_camera ? node_of(a.camera_orbit_deg) : no_value();
                          },
                          [](const KeyTarget& t, const Node& n) {
                              t.scene.animation.moves_camera = true;
                              take(n, t.scene.animation.camera_orbit_deg);
                          }};

constexpr KeyField kElevation{KeyKind::kNumber2,
                              [](const KeySource& s) {
                                  const Animation& a = s.scene.animation;
                                  return a.moves_sun ? node_of(a.sun_elevation_deg) : no_value();
                              },
                              [](const KeyTarget& t, const Node& n) {
                                  t.scene.animation.moves_sun = true;
                                  take(n, t.scene.animation.sun_elevation_deg);
                              }};

constexpr KeyField kHours{KeyKind::kNumber2,
                          [](const KeySource& s) {
                              const Animation& a = s.scene.animation;
                              return a.moves_time ? node_of(a.hours) : no_value();
                          },
                          [](const KeyTarget& t, const Node& n) {
                              t.scene.animation.moves_time = true;
                              take(n, t.scene.animation.hours);
                          }};

constexpr KeyRow kRows[] = {
    {"output.files", output<&OutputSettings::files>, any(), "",
     "pictures to write, relative to the scene's folder; names end in .exr, .png, "
     ".pfm or .nc"},
    {"output.report", output<&OutputSettings::report>, any(), "",
     "JSON report to write, relative to the scene's folder; empty: none"},
    {"output.layers", kLayers,
     one_of("radiance|alpha|depth|error|cloud|optical_depth|transmittance|light|order|reflectance|"
            "shadow|occlusion"),
     "", "layers of the picture; radiance and alpha are always there"},
    {"animation.frames", animation<&Animation::frames>, from_to(1, 1000000), "",
     "number of pictures"},
    {"animation.camera_orbit_deg", kOrbit, from_to(-36000, 36000), "deg",
     "first and last angle by which the camera has turned about its target", kNoNote},
    {"animation.sun_elevation_deg", kElevation, from_to(-90, 90), "deg",
     "first and last elevation of the sun; needs a sun", kNoNote},
    {"animation.hours", kHours, from_to(-8784, 8784), "h",
     "first and last time, counted from atmosphere.date and time, which it needs", kNoNote},
};

}  // namespace

Span<const KeyRow> output_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
