// SPDX-License-Identifier: Apache-2.0
// Rows of the key table for solid things: meshes of triangles.
// in: checked TOML values -> out: fields of SolidSettings.
// docs/scene.md; docs/solids.md.
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

constexpr KeyRange kMetres{-1e9, 1e9, false, false};

const KeyRow kRows[] = {
    plain_key(KeyKind::kText, "solid.N.file", kRequired,
              "mesh of triangles or polygons, .obj, .ply, .gltf or .glb; relative to the scene "
              "file, `${PILEUS_DATA_DIR}` may stand at its front",
              nullptr),
    range_key(KeyKind::kColor, "solid.N.albedo", "", "0.2", {0, 1, false, false},
              "share of the light that it sends back, alike in all directions",
              [](const Node& n, KeyTarget t) { t.solid.albedo = color_of(n); }),
    range_key(KeyKind::kNumber3, "solid.N.position_m", "m", "[0, 0, 0]", kMetres,
              "where the file's origin stands",
              [](const Node& n, KeyTarget t) { t.solid.position_m = number3_of(n); }),
    range_key(KeyKind::kNumber, "solid.N.scale", "m", "1", {0, 1e9, true, false},
              "metres per unit of the file",
              [](const Node& n, KeyTarget t) { t.solid.scale = number_of(n); }),
    range_key(KeyKind::kNumber3, "solid.N.rotation_deg", "deg", "[0, 0, 0]",
              {-360, 360, false, false}, "turns it about x, then y, then z",
              [](const Node& n, KeyTarget t) { t.solid.rotation_deg = number3_of(n); }),
    plain_key(KeyKind::kBool, "solid.N.y_up", "false",
              "the file's y axis points up and becomes z; glTF: always",
              [](const Node& n, KeyTarget t) { t.solid.y_up = n.flag; }),
};

}  // namespace

Span<const KeyRow> solid_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
