// SPDX-License-Identifier: Apache-2.0
// Keys of one scattering medium but its phase function's: its density, optics and detail.
// in: checked values <-> out: fields of MediumSettings.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"
#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField medium = field<Members...>;

template <auto Member>
constexpr KeyField source = field<&MediumSettings::source, Member>;
template <auto Member>
constexpr KeyField box = field<&MediumSettings::box, Member>;
template <auto Member>
constexpr KeyField optics = field<&MediumSettings::optics, Member>;

/// A name or a path; a table is read key by key.
constexpr KeyField kDensity{KeyKind::kDensity,
                            [](const KeySource& s) {
                                const std::string& name = s.medium.density;
                                return node_of(name.empty() ? s.medium.source.file : name);
                            },
                            [](const KeyTarget& t, const Node& n) {
                                if (!n.is_text()) return;
                                const bool file = density_row(n.text) == nullptr;
                                (file ? t.medium.source.file : t.medium.density) = n.text;
                                if (file) t.medium.density.clear();
                            }};
constexpr KeyField kDensityFile{KeyKind::kText, [](const KeySource&) { return no_value(); },
                                [](const KeyTarget& t, const Node& n) {
                                    t.medium.density.clear();
                                    t.medium.source.file = n.text;
                                }};
/// Another way to say `grid`.
constexpr KeyField kDensityGrid{
    KeyKind::kText, [](const KeySource&) { return no_value(); },
    [](const KeyTarget& t, const Node& n) { t.medium.source.grid = n.text; }};

constexpr KeyField kBounds{KeyKind::kBounds,
                           [](const KeySource& s) {
                               return s.medium.box.has_bounds ? node_of(s.medium.box.bounds_m)
                                                              : no_value();
                           },
                           [](const KeyTarget& t, const Node& n) {
                               t.medium.box.has_bounds = true;
                               take(n, t.medium.box.bounds_m);
                           }};

constexpr KeyRow kRows[] = {
    {"medium.N.density", kDensity, any(), "",
     "name of a density that the program makes, filling bounds_m; the path of a file; or a table "
     "for a raw, OpenVDB, NanoVDB or NetCDF file, or one of particles",
     kRequired},
    {"medium.N.density.file", kDensityFile, any(), "",
     "path of the file, relative to the scene file; `${PILEUS_DATA_DIR}` may stand at "
     "its front; a run of `#` in its name stands for the number of an animation's frame",
     kRequired},
    {"medium.N.density.first_frame", source<&MediumFile::first_frame>, from_to(0, 1e9), "",
     "of a sequence, a file whose name has `#`: the number that stands there in frame 0"},
    {"medium.N.density.type", source<&MediumFile::raw_type>, one_of("uint8|uint16|float32"), "",
     "type of the raw numbers; integers are scaled to 0..1; required for raw", kNoNote},
    {"medium.N.density.size", source<&MediumFile::raw_size>, ranged(&MediumFile::raw_size), "cells",
     "cells along x, y, z of the raw file, x fastest; required for raw", kNoNote},
    {"medium.N.density.endian", source<&MediumFile::raw_big_endian>, one_of("little|big"), "",
     "byte order of the raw file"},
    {"medium.N.density.grid", kDensityGrid, any(), "",
     "the same as `grid` beside it: name of the grid in an OpenVDB or NanoVDB file", kNoNote},
    {"medium.N.format", source<&MediumFile::format>,
     one_of("pbrt|raw|vol|les|openvdb|nanovdb|netcdf|grib|ply|csv|prt|bgeo|pdb|pda"), "",
     "kind of the file; left out: told by the end of its name", kNoNote},
    {"medium.N.grid", source<&MediumFile::grid>, any(), "",
     "name of the grid in an OpenVDB or NanoVDB file, of several of one name with a number, "
     "`density[1]`; left out: `density`, or else the first of floats that is no level set",
     kNoNote},
    {"medium.N.bounds_m", kBounds, from_to(-1e9, 1e9), "m",
     "lowest and highest corner of the medium's box; may be left out for files that know "
     "their place, and wins where given",
     kNoNote},
    {"medium.N.resolution", box<&MediumBox::resolution>, ranged(&MediumBox::resolution), "cells",
     "cells along x, y, z; procedural, uniform, NetCDF and particles only; left out: a suitable "
     "number",
     kNoNote},
    {"medium.N.shape_seed", medium<&MediumSettings::shape_seed>, from_to(0, 0x1p63), "",
     "another procedural cloud for each number"},
    {"medium.N.extinction_per_m", optics<&MediumOptics::extinction_per_m>, from_to(0, 1e12), "1/m",
     "extinction coefficient where the density is 1; required, but for files that hold "
     "extinction (les, netcdf; particles, where it is a factor) and beside `transfer`",
     kNoNote},
    {"medium.N.extinction_scale", optics<&MediumOptics::extinction_scale>, from_to(0, 1e12), "",
     "factor on the values of a file that holds extinction in 1/m (les, netcdf), for no others"},
    {"medium.N.albedo", optics<&MediumOptics::albedo>, from_to(0, 1), "",
     "share of the extinction that scatters; the rest is absorbed"},
    {"medium.N.emission", optics<&MediumOptics::emission>, from_to(0, 1e9), "",
     "radiance that the medium adds per metre where the density is 1, in the sun's unit per m and "
     "sr; it goes with the density as the extinction does (docs/lights.md, \"Media that emit\")"},
};

/// What stands behind the phase function.
constexpr KeyRow kLastRows[] = {
    {"medium.N.boundary", box<&MediumBox::periodic>, one_of("open|periodic"), "",
     "what lies beside the box: nothing, or the same again without end along x and y; "
     "periodic for all media of a scene, with one box in x and y, or for none"},
    {"medium.N.interpolation", box<&MediumBox::constant>, one_of("linear|constant"), "",
     "the density between the middles of cells: linear from one to the next, or one value for "
     "each cell; the same for all media of a scene"},
    {"medium.N.y_up", source<&MediumFile::y_up>, any(), "",
     "true: the file's y axis points up; files only"},
};

template <auto Member>
constexpr KeyField detail = field<&MediumSettings::detail, Member>;

/// Of detail beyond its grid; docs/detail.md.
constexpr KeyRow kDetailRows[] = {
    {"medium.N.detail.tile_m", detail<&DetailSettings::tile_m>, positive(1e9), "m",
     "length after which the noise repeats; required in this table, and left out with it: no "
     "detail (docs/detail.md)",
     kNoNote},
    {"medium.N.detail.strength", detail<&DetailSettings::strength>, from_to(0, 1), "",
     "how far the noise changes a density: at 1 down to nothing; 0: no detail"},
    {"medium.N.detail.dense", detail<&DetailSettings::dense>, from_to(0, 1), "",
     "share of the strength that is left at the largest density; linear below it"},
    {"medium.N.detail.noise", detail<&DetailSettings::noise>, one_of("perlin|worley"), "",
     "kind of noise: wisps, or round lumps"},
    {"medium.N.detail.octaves", detail<&DetailSettings::octaves>, from_to(0, 6), "",
     "octaves of the noise, the first of 4 lumps a tile, each half as large and strong as the one "
     "before; 0: down to four cells a lump"},
    {"medium.N.detail.seed", detail<&DetailSettings::seed>, from_to(0, 0x1p32 - 1), "",
     "another noise for each number"},
    {"medium.N.detail.age", detail<&DetailSettings::age>, from_to(0, 1e6), "lives",
     "lives of the lumps that have passed: they change shape with it, and after a whole one all "
     "are "
     "others (docs/detail.md)"},
    {"medium.N.detail.cells", detail<&DetailSettings::cells>, from_to(16, 128), "cells",
     "cells along the tile's edges: a power of two"},
    {"medium.N.detail.refine", detail<&DetailSettings::refine>, from_to(0, 16), "cells",
     "0: the detail is made while marching, for methods that march through one medium; else it is "
     "laid on a grid in which each cell becomes so many along each axis, for any method"},
};

}  // namespace

Span<const KeyRow> medium_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }
Span<const KeyRow> medium_last_keys() {
    return {kLastRows, sizeof kLastRows / sizeof kLastRows[0]};
}
Span<const KeyRow> detail_keys() {
    return {kDetailRows, sizeof kDetailRows / sizeof kDetailRows[0]};
}

}  // namespace pileus
