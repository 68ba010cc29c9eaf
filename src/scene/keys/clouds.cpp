// SPDX-License-Identifier: Apache-2.0
// Keys of a sky of many clouds: kinds, places, how exact far ones are.
// in: checked values <-> out: fields of CloudsSettings.
// docs/clouds.md; docs/scene.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField detail = field<&Scene::clouds, &CloudsSettings::detail, Members...>;

template <auto Member>
constexpr KeyField weather = field<&Scene::clouds, &CloudsSettings::weather, Member>;
using Weather = ReportSettings;

template <class Value>
void take_member(const Node& table, const char* key, Value& value) {
    if (const Node* node = table.find(key)) take(*node, value);
}

Node node_of_row(const CloudKindSettings& kind) {
    Node node;
    node.children = {named("name", node_of(kind.name)), named("scene", node_of(kind.scene)),
                     named("set", node_of(kind.sets))};
    return node;
}
void take_row(const Node& node, CloudKindSettings& kind) {
    take_member(node, "name", kind.name);
    take_member(node, "scene", kind.scene);
    take_member(node, "set", kind.sets);
}

Node node_of_row(const CloudLayerSettings& layer) {
    Node node;
    node.children = {named("scene", node_of(layer.scene)), named("set", node_of(layer.sets))};
    return node;
}
void take_row(const Node& node, CloudLayerSettings& layer) {
    take_member(node, "scene", layer.scene);
    take_member(node, "set", layer.sets);
}

Node node_of_row(const CloudPlaceSettings& place) {
    Node node;
    node.children = {named("kind", node_of(place.kind)), named("offset_m", node_of(place.offset_m)),
                     named("yaw_deg", node_of(place.yaw_deg)),
                     named("scale", node_of(place.scale))};
    return node;
}
void take_row(const Node& node, CloudPlaceSettings& place) {
    take_member(node, "kind", place.kind);
    take_member(node, "offset_m", place.offset_m);
    take_member(node, "yaw_deg", place.yaw_deg);
    take_member(node, "scale", place.scale);
}

Node node_of_row(const CloudScatter& s) {
    Node node;
    node.children = {named("kinds", node_of(s.kinds)), named("count", node_of(s.count)),
                     named("seed", node_of(s.seed)),   named("near_m", node_of(s.near_m)),
                     named("far_m", node_of(s.far_m)), named("base_m", node_of(s.base_m)),
                     named("scale", node_of(s.scale)), named("yaw_steps", node_of(s.yaw_steps))};
    if (s.has_center) node.children.push_back(named("center_m", node_of(s.center_m)));
    return node;
}
void take_row(const Node& node, CloudScatter& s) {
    take_member(node, "kinds", s.kinds);
    take_member(node, "count", s.count);
    take_member(node, "seed", s.seed);
    take_member(node, "near_m", s.near_m);
    take_member(node, "far_m", s.far_m);
    take_member(node, "base_m", s.base_m);
    take_member(node, "scale", s.scale);
    take_member(node, "yaw_steps", s.yaw_steps);
    s.has_center = node.find("center_m") != nullptr;
    take_member(node, "center_m", s.center_m);
}

/// A list of tables, an element of a vector each.
template <auto List>
constexpr KeyField rows{KeyKind::kRows,
                        [](const KeySource& s) {
                            Node list;
                            list.kind = NodeKind::kArray;
                            for (const auto& row : s.scene.clouds.*List)
                                list.children.push_back(node_of_row(row));
                            return list;
                        },
                        [](const KeyTarget& t, const Node& n) {
                            auto& list = t.scene.clouds.*List;
                            list.clear();
                            for (const Node& child : n.children) {
                                list.emplace_back();
                                take_row(child, list.back());
                            }
                        }};

constexpr KeyField kOff{
    KeyKind::kBool, [](const KeySource& s) { return node_of(!s.scene.clouds.detail.on); },
    [](const KeyTarget& t, const Node& n) { t.scene.clouds.detail.on = !n.flag; }};

constexpr KeyRow kKindRows[] = {
    {"name", KeyKind::kText, any(), "", "", kRequired},
    {"scene", KeyKind::kText, any(), "", "", kRequired},
    {"set", KeyKind::kTexts, any(), "", ""},
};
constexpr KeyRow kLayerRows[] = {
    {"scene", KeyKind::kText, any(), "", "", kRequired},
    {"set", KeyKind::kTexts, any(), "", ""},
};
constexpr KeyRow kPlaceRows[] = {
    {"kind", KeyKind::kText, any(), "", "", kRequired},
    {"offset_m", KeyKind::kNumber3, ranged(&CloudPlaceSettings::offset_m), "m", "", kRequired},
    {"yaw_deg", KeyKind::kNumber, ranged(&CloudPlaceSettings::yaw_deg), "deg", ""},
    {"scale", KeyKind::kNumber, ranged(&CloudPlaceSettings::scale), "", ""},
};
constexpr KeyRow kScatterRows[] = {
    {"kinds", KeyKind::kTexts, any(), "", ""},
    {"count", KeyKind::kInteger, from_to(1, double(kMaxClouds)), "", "", kRequired},
    {"seed", KeyKind::kInteger, from_to(0, 0x1p63), "", ""},
    {"near_m", KeyKind::kNumber, from_to(1, 1e6), "m", ""},
    {"far_m", KeyKind::kNumber, from_to(1, 1e6), "m", ""},
    {"center_m", KeyKind::kNumber2, from_to(-1e6, 1e6), "m", ""},
    {"base_m", KeyKind::kNumber2, from_to(-1e5, 1e5), "m", "", kRequired},
    {"scale", KeyKind::kNumber2, ranged(&CloudPlaceSettings::scale), "", ""},
    {"yaw_steps", KeyKind::kInteger, from_to(1, 360), "", ""},
};

template <const auto& Rows>
Span<const KeyRow> keys_in() {
    return {Rows, sizeof Rows / sizeof Rows[0]};
}
constexpr RowList kKinds{keys_in<kKindRows>, nullptr, 1, kMaxCloudKinds};
constexpr RowList kLayers{keys_in<kLayerRows>, nullptr, 1, kMaxCloudLayers};
constexpr RowList kPlaces{keys_in<kPlaceRows>, nullptr, 1, kMaxClouds};
constexpr RowList kScatters{keys_in<kScatterRows>, nullptr, 1, kMaxScatters};

constexpr KeyRow kRows[] = {
    {"clouds.kind", rows<&CloudsSettings::kinds>, any(), "",
     "kinds of clouds, `[[clouds.kind]]`: a name, the file of a scene with media, and what `set` "
     "changes in it, as --set; docs/clouds.md",
     kNoNote, &kKinds},
    {"clouds.place", rows<&CloudsSettings::places>, any(), "",
     "clouds, `[[clouds.place]]`: a kind, turned about its z axis, made larger, shifted", kNoNote,
     &kPlaces},
    {"clouds.scatter", rows<&CloudsSettings::scatters>, any(), "",
     "many clouds, `[[clouds.scatter]]`, by random numbers, none over another; docs/clouds.md has "
     "ranges and defaults",
     kNoNote, &kScatters},
    {"clouds.layer", rows<&CloudsSettings::layers>, any(), "",
     "sheets of clouds, `[[clouds.layer]]`: the file of a scene with media, which stay where they "
     "are in it and may have no end, and what `set` changes in it; docs/clouds.md",
     kNoNote, &kLayers},
    {"clouds.detail.off", kOff, any(), "", "march every cloud whole in every picture"},
    {"clouds.detail.error_px", detail<&CloudDetail::error_px>, ranged(&CloudDetail::error_px),
     "pixel", "that parts of a far cloud may be off"},
    {"clouds.detail.near_px", detail<&CloudDetail::near_px>, ranged(&CloudDetail::near_px), "pixel",
     "clouds of that size are marched in every picture"},
    {"clouds.detail.near_scale", detail<&CloudDetail::near_scale>, from_to(1, 4), "",
     "of those one pixel of so many along x and y is marched: 1, 2 or 4"},
    {"clouds.detail.blend_frames", detail<&CloudDetail::blend_frames>,
     ranged(&CloudDetail::blend_frames), "",
     "frames over which an impostor of a far cloud cross-fades to the next"},
    {"clouds.detail.sharpness", detail<&CloudDetail::sharpness>, ranged(&CloudDetail::sharpness),
     "", "texels of a far cloud for a pixel along x and y"},
    {"clouds.detail.frame_pixels", detail<&CloudDetail::frame_pixels>, from_to(1, 0x1p62), "",
     "of far clouds, that one picture may draw anew"},
    {"clouds.detail.sun_deg", detail<&CloudDetail::sun_deg>, ranged(&CloudDetail::sun_deg), "deg",
     "that the sun may move before clouds are lit anew"},
    {"weather.metar", weather<&Weather::metar>, any(), "",
     "a report of the weather, METAR or SPECI, of which clouds, haze and rain are made; needs "
     "[atmosphere]; docs/metar.md",
     kNoNote},
    {"weather.seed", weather<&Weather::seed>, from_to(0, 0x1p32 - 1), "",
     "other clouds of the same report"},
    {"weather.elevation_m", weather<&Weather::elevation_m>, from_to(-500, 6000), "m",
     "of the station, above which a report counts heights"},
};

}  // namespace

Span<const KeyRow> clouds_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
