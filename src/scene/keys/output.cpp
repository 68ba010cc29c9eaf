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

constexpr JoinedNames layer_names() {
    JoinedNames names;
    names.add("radiance");
    names.add("alpha");
    for (const LayerFlag& layer : kLayerFlags) names.add(layer.name);
    return names;
}
constexpr JoinedNames kLayerNames = layer_names();

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

constexpr const char* kWays = "smooth|linear|step";

Node node_of_key(const AnimationKey& key) {
    Node node;
    node.children = {named("frame", node_of(key.frame)),
                     named("way", node_of(std::string(split_list(kWays)[std::size_t(key.way)])))};
    for (std::size_t t = 0; t < std::size_t(kTrackCount); ++t) {
        const double* n = &key.numbers[std::size_t(kTracks[t].first)];
        if (!key.given[t]) continue;
        node.children.push_back(named(kTracks[t].name, kTracks[t].numbers == 3
                                                           ? node_of(Double3{n[0], n[1], n[2]})
                                                           : node_of(*n)));
    }
    return node;
}

AnimationKey key_of(const Node& node) {
    AnimationKey key;
    take(*node.find("frame"), key.frame);
    if (const Node* way = node.find("way")) key.way = KeyWay(place_in(kWays, way->text));
    for (std::size_t t = 0; t < std::size_t(kTrackCount); ++t) {
        const Node* value = node.find(kTracks[t].name);
        key.given[t] = value != nullptr;
        if (value == nullptr) continue;
        double* n = &key.numbers[std::size_t(kTracks[t].first)];
        if (kTracks[t].numbers == 3) {
            const Double3 v = number3_of(*value);
            for (int a = 0; a < 3; ++a) n[a] = v[a];
        } else {
            *n = number_of(*value);
        }
    }
    return key;
}

constexpr KeyField kAnimationKeys{KeyKind::kRows,
                                  [](const KeySource& s) {
                                      Node list;
                                      list.kind = NodeKind::kArray;
                                      for (const AnimationKey& key : s.scene.animation.keys)
                                          list.children.push_back(node_of_key(key));
                                      return list;
                                  },
                                  [](const KeyTarget& t, const Node& n) {
                                      t.scene.animation.keys.clear();
                                      for (const Node& child : n.children)
                                          t.scene.animation.keys.push_back(key_of(child));
                                  }};

constexpr KeyRow kKeyRows[] = {
    {"frame", KeyKind::kInteger, from_to(0, 1000000), "", "", kRequired},
    {"way", KeyKind::kText, one_of(kWays), "", ""},
    {"camera_position_m", KeyKind::kNumber3, ranged(&Camera::position_m), "m", ""},
    {"camera_target_m", KeyKind::kNumber3, ranged(&Camera::target_m), "m", ""},
    {"camera_fov_deg", KeyKind::kNumber, ranged(&Camera::fov_deg), "deg", ""},
    {"sun_azimuth_deg", KeyKind::kNumber, from_to(-36000, 36000), "deg", ""},
    {"sun_elevation_deg", KeyKind::kNumber, ranged(&Sun::elevation_deg), "deg", ""},
    {"hours", KeyKind::kNumber, from_to(-8784, 8784), "h", ""},
    {"wind_s", KeyKind::kNumber, from_to(-1e9, 1e9), "s", ""},
    {"media_offset_m", KeyKind::kNumber3, ranged(&Placement::offset_m), "m", ""},
    {"media_yaw_deg", KeyKind::kNumber, from_to(-36000, 36000), "deg", ""},
};

Span<const KeyRow> key_rows() { return {kKeyRows, sizeof kKeyRows / sizeof kKeyRows[0]}; }
constexpr RowList kKeyList{key_rows, "frame", 1, kMaxKeys};

constexpr KeyRow kRows[] = {
    {"output.files", output<&OutputSettings::files>, any(), "",
     "pictures to write, relative to the scene's folder; names end in .exr, .png, "
     ".pfm or .nc"},
    {"output.report", output<&OutputSettings::report>, any(), "",
     "JSON report to write, relative to the scene's folder; empty: none"},
    {"output.layers", kLayers, one_of(kLayerNames.text), "",
     "layers of the picture; radiance and alpha are always there"},
    {"animation.frames", animation<&Animation::frames>, from_to(1, 1000000), "",
     "number of pictures"},
    {"animation.camera_orbit_deg", kOrbit, from_to(-36000, 36000), "deg",
     "first and last angle by which the camera has turned about its target", kNoNote},
    {"animation.sun_elevation_deg", kElevation, ranged(&Sun::elevation_deg), "deg",
     "first and last elevation of the sun; needs a sun", kNoNote},
    {"animation.hours", kHours, from_to(-8784, 8784), "h",
     "first and last time, counted from atmosphere.date and time, which it needs", kNoNote},
    {"animation.keys", kAnimationKeys, any(), "",
     "what moves, by rising frames: each key gives what it has at its frame, and the `way` to the "
     "next key that has it; docs/animation.md",
     kNoNote, &kKeyList},
};

}  // namespace

Span<const KeyRow> output_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
