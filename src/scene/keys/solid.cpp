// SPDX-License-Identifier: Apache-2.0
// Keys of solid things: meshes of triangles.
// in: checked values <-> out: fields of SolidSettings.
// docs/scene.md; docs/solids.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField solid = field<Members...>;

constexpr KeyRow kRows[] = {
    {"solid.N.file", solid<&SolidSettings::file>, any(), "",
     "mesh of triangles or polygons, .obj, .ply, .gltf or .glb; relative to the scene "
     "file, `${PILEUS_DATA_DIR}` may stand at its front",
     kRequired},
    {"solid.N.albedo", solid<&SolidSettings::albedo>, from_to(0, 1), "",
     "share of the light that it sends back, alike in all directions"},
    {"solid.N.position_m", solid<&SolidSettings::position_m>, from_to(-1e9, 1e9), "m",
     "where the file's origin stands"},
    {"solid.N.scale", solid<&SolidSettings::scale>, positive(1e9), "m",
     "metres per unit of the file"},
    {"solid.N.rotation_deg", solid<&SolidSettings::rotation_deg>, from_to(-360, 360), "deg",
     "turns it about x, then y, then z"},
    {"solid.N.y_up", solid<&SolidSettings::y_up>, any(), "",
     "the file's y axis points up and becomes z; glTF: always"},
};

}  // namespace

Span<const KeyRow> solid_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
