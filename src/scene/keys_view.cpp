// SPDX-License-Identifier: Apache-2.0
// Rows of the key table for what surrounds the cloud: camera, sun, sky and ground.
// in: checked TOML values -> out: fields of Scene.
// docs/scene.md.
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

constexpr KeyRange kMetres{-1e9, 1e9, false, false};
constexpr KeyRange kLight{0, 1e12, false, false};
constexpr KeyRange kSeeds{0, 0x1p63, false, false};

const KeyRow kRows[] = {
    range_key(KeyKind::kInteger, "seed", "", "0", kSeeds,
              "chooses the random numbers; the same seed gives the same picture, bit for bit",
              [](const Node& n, KeyTarget t) { t.scene.seed = integer_of(n); }),

    range_key(KeyKind::kNumber3, "camera.position_m", "m", kRequired, kMetres,
              "where the camera stands; x to the east, y to the north, z up",
              [](const Node& n, KeyTarget t) { t.scene.camera.position_m = number3_of(n); }),
    range_key(KeyKind::kNumber3, "camera.target_m", "m", kRequired, kMetres,
              "a point in the middle of the picture; not the position",
              [](const Node& n, KeyTarget t) { t.scene.camera.target_m = number3_of(n); }),
    range_key(KeyKind::kNumber3, "camera.up", "", "[0, 0, 1]", kMetres,
              "a direction that points up in the picture; not along the view",
              [](const Node& n, KeyTarget t) { t.scene.camera.up = number3_of(n); }),
    choice_key(KeyKind::kText, "camera.projection", "\"perspective\"",
               "perspective|orthographic|flux", nullptr,
               "how space is mapped to the picture; `flux`, method `path` only: pixels tile a flat "
               "detector through position_m that faces target_m, and show its irradiance",
               [](const Node& n, KeyTarget t) {
                   t.scene.camera.orthographic = n.text != "perspective";
                   t.scene.camera.flux = n.text == "flux";
               }),
    range_key(KeyKind::kNumber, "camera.fov_deg", "deg", "40", {0, 180, true, true},
              "vertical field of view; perspective only",
              [](const Node& n, KeyTarget t) { t.scene.camera.fov_deg = number_of(n); }),
    range_key(KeyKind::kNumber, "camera.height_m", "m", "2000", {0, 1e9, true, false},
              "height of the picture in space; orthographic and flux only",
              [](const Node& n, KeyTarget t) { t.scene.camera.height_m = number_of(n); }),
    range_key(KeyKind::kInteger2, "camera.resolution", "pixels", "[960, 540]",
              {1, 16384, false, false}, "width and height of the picture",
              [](const Node& n, KeyTarget t) {
                  for (std::size_t i = 0; i < 2; ++i)
                      t.scene.camera.resolution[i] = static_cast<int>(integer_of(n.children[i]));
              }),
    plain_key(KeyKind::kText, "camera.depth", "",
              "image of the distance to solid things, .exr (channel Z, or its only one) or grey "
              ".pfm, of the picture's size; what lies behind is left out, and black",
              nullptr),
    choice_key(KeyKind::kText, "camera.depth_kind", "\"distance\"", "distance|z", nullptr,
               "its values: along each pixel's ray, or along the view's axis",
               [](const Node& n, KeyTarget t) { t.scene.camera.depth_on_axis = n.text == "z"; }),
    range_key(KeyKind::kNumber, "camera.depth_scale", "m", "1", {0, 1e9, true, false},
              "metres per unit of its values",
              [](const Node& n, KeyTarget t) { t.scene.camera.depth_scale = number_of(n); }),

    range_key(KeyKind::kNumber, "sun.azimuth_deg", "deg", "0", {-360, 360, false, false},
              "where the sun stands, from north (+y) towards east (+x)",
              [](const Node& n, KeyTarget t) { t.scene.sun.azimuth_deg = number_of(n); }),
    range_key(KeyKind::kNumber, "sun.elevation_deg", "deg", "45", {-90, 90, false, false},
              "how high the sun stands over the horizon",
              [](const Node& n, KeyTarget t) { t.scene.sun.elevation_deg = number_of(n); }),
    range_key(KeyKind::kColor, "sun.irradiance", "any", "[1, 1, 1]", kLight,
              "on a plane facing the sun; radiances come out in its unit",
              [](const Node& n, KeyTarget t) { t.scene.sun.irradiance = color_of(n); }),

    range_key(KeyKind::kColor, "sky.radiance", "sun's per sr", "[0, 0, 0]", kLight,
              "of a constant sky: the full sphere, or the upper half where there is a ground",
              [](const Node& n, KeyTarget t) { t.scene.sky.radiance = color_of(n); }),
    plain_key(KeyKind::kText, "sky.map", "",
              "latitude-longitude image of the sky's radiance, .exr or .pfm, in place of radiance; "
              "relative to the scene file, `${PILEUS_DATA_DIR}` may stand at its front",
              nullptr),
    range_key(KeyKind::kNumber, "sky.map_scale", "", "1", kLight, "factor on the map's values",
              [](const Node& n, KeyTarget t) { t.scene.sky.map_scale = number_of(n); }),
    range_key(KeyKind::kNumber, "sky.map_rotation_deg", "deg", "0", {-360, 360, false, false},
              "turns the map about the vertical, from north towards east; at 0 its middle column "
              "stands in the north (+y)",
              [](const Node& n, KeyTarget t) { t.scene.sky.map_rotation_deg = number_of(n); }),
    later_key("sky.model", "a computed sky"),

    range_key(KeyKind::kNumber, "ground.altitude_m", "m", "0", kMetres,
              "height of the level ground; every medium and the camera stand above it",
              [](const Node& n, KeyTarget t) { t.scene.ground.altitude_m = number_of(n); }),
    range_key(KeyKind::kNumber, "ground.albedo", "", "0.2", {0, 1, false, false},
              "share of the light that the ground sends back, alike in all directions",
              [](const Node& n, KeyTarget t) { t.scene.ground.albedo = number_of(n); }),
};

}  // namespace

Span<const KeyRow> view_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
