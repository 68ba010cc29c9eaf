// SPDX-License-Identifier: Apache-2.0
// Keys of solid things: meshes of triangles, and maps of heights that become such.
// in: checked values <-> out: fields of SolidSettings.
// docs/scene.md; docs/solids.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField solid = field<Members...>;
template <auto Member>
constexpr KeyField heights = field<&SolidSettings::heights, Member>;

constexpr KeyRow kRows[] = {
    {"solid.N.file", solid<&SolidSettings::file>, any(), "",
     "mesh of triangles or polygons, .obj, .ply, .gltf or .glb, or a map of heights, .png, .exr, "
     ".pfm, .tif, .tiff, .hgt or .raw; relative to the scene file, `${PILEUS_DATA_DIR}` may stand "
     "at its front",
     kRequired},
    {"solid.N.albedo", solid<&SolidSettings::albedo>, from_to(0, 1), "",
     "share of the light that it sends back, alike in all directions"},
    {"solid.N.albedo_map", solid<&SolidSettings::albedo_map>, any(), "",
     "in its place a picture, .png (sRGB), .exr or .pfm, laid from above over all of the mesh's x "
     "and y, north up: a colour for each triangle, from its middle"},
    {"solid.N.albedo_map_scale", solid<&SolidSettings::albedo_map_scale>, positive(1e6), "",
     "values of the map are multiplied by this; all must come to lie in [0, 1]"},
    {"solid.N.smooth", solid<&SolidSettings::smooth>, one_of("auto|false|true"), "",
     "light takes the surface to be curved, by normals between those of corners that triangles "
     "share; auto: maps of heights alone"},
    {"solid.N.position_m", solid<&SolidSettings::position_m>, from_to(-1e9, 1e9), "m",
     "where the file's origin stands"},
    {"solid.N.scale", solid<&SolidSettings::scale>, positive(1e9), "m",
     "metres per unit of the file; of a map of heights upwards alone"},
    {"solid.N.rotation_deg", solid<&SolidSettings::rotation_deg>, from_to(-360, 360), "deg",
     "turns it about x, then y, then z"},
    {"solid.N.y_up", solid<&SolidSettings::y_up>, any(), "",
     "the file's y axis points up and becomes z; glTF: always"},
    {"solid.N.bounds_m", heights<&HeightMapSettings::bounds_m>, from_to(-1e9, 1e9), "m",
     "where the outer samples of a map of heights lie, its south-west and north-east corner; "
     "required, but of a GeoTIFF that says so itself",
     kNoNote},
    {"solid.N.height_m", heights<&HeightMapSettings::height_m>, from_to(-1e6, 1e6), "m",
     "heights of integer samples, of 0 and of all bits set; required for .png, else samples "
     "are metres times `scale`",
     kNoNote},
    {"solid.N.holes", heights<&HeightMapSettings::holes>, one_of("refuse|fill"), "",
     "samples without a height: a fault, or filled from the nearest to the north, east, south and "
     "west, the nearer the heavier"},
    {"solid.N.every", heights<&HeightMapSettings::every>, from_to(1, kMaxHeightSide), "samples",
     "the mean of so many samples along each side is one of the mesh"},
    {"solid.N.raw_size", heights<&HeightMapSettings::raw_size>, from_to(1, kMaxHeightSide),
     "samples", "columns and rows of a .raw map, from the north-west, row by row; required for it",
     kNoNote},
    {"solid.N.raw_type", heights<&HeightMapSettings::raw_type>, one_of("int16|uint16|float32"), "",
     "numbers of a .raw map"},
    {"solid.N.raw_endian", heights<&HeightMapSettings::raw_big_endian>, one_of("little|big"), "",
     "byte order of a .raw map"},
};

}  // namespace

Span<const KeyRow> solid_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
