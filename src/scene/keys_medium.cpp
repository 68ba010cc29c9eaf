// SPDX-License-Identifier: Apache-2.0
// Rows of the key table for one scattering medium: its density, optics and phase function.
// in: checked TOML values -> out: fields of MediumSettings.
// docs/scene.md; Henyey and Greenstein 1941 for g.
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

constexpr KeyRange kCosine{-1, 1, false, false};
constexpr KeyRange kShare{0, 1, false, false};
constexpr KeyRange kCells{1, 4096, false, false};

/// In the order of PhaseKind.
constexpr const char* kPhases =
    "isotropic|rayleigh|henyey-greenstein|two-lobe|hg-draine|cloud|table|moments";

PhaseKind phase_kind(const std::string& name) {
    int kind = 0;
    for (std::string_view choice : split_list(kPhases)) {
        if (choice == name) break;
        ++kind;
    }
    return static_cast<PhaseKind>(kind);
}

/// Kinds of water clouds and their effective radii, um (docs/phase.md, "Kinds of clouds").
constexpr const char* kClouds =
    "cumulus-clean|cumulus-polluted|cumulus-maritime|stratus-continental|stratus-maritime|fog";
constexpr double kCloudRadius[] = {5.77, 4, 12.68, 7.33, 11.3, 10.7};

double cloud_radius(const std::string& name) {
    std::size_t kind = 0;
    for (std::string_view choice : split_list(kClouds)) {
        if (choice == name) break;
        ++kind;
    }
    return kCloudRadius[kind];
}

RawType raw_type(const std::string& name) {
    if (name == "uint8") return RawType::kUint8;
    return name == "uint16" ? RawType::kUint16 : RawType::kFloat32;
}

void set_cells(const Node& n, std::array<int, 3>& cells) {
    for (std::size_t i = 0; i < 3; ++i) cells[i] = static_cast<int>(integer_of(n.children[i]));
}

const KeyRow kRows[] = {
    plain_key(KeyKind::kDensity, "medium.N.density", kRequired,
              "`procedural:cumulus`, `procedural:sky`, `uniform:box`, `uniform:sphere`, "
              "`uniform:ellipsoid` (filling "
              "bounds_m), the path of a file, or a table for a raw, OpenVDB or NanoVDB file",
              nullptr),
    plain_key(KeyKind::kText, "medium.N.density.file", kRequired,
              "path of the file, relative to the scene file; `${PILEUS_DATA_DIR}` may stand at "
              "its front",
              nullptr),
    choice_key(KeyKind::kText, "medium.N.density.type", "", "uint8|uint16|float32", nullptr,
               "type of the raw numbers; integers are scaled to 0..1; required for raw",
               [](const Node& n, KeyTarget t) { t.medium.raw_type = raw_type(n.text); }),
    range_key(KeyKind::kInteger3, "medium.N.density.size", "cells", "", kCells,
              "cells along x, y, z of the raw file, x fastest; required for raw",
              [](const Node& n, KeyTarget t) { set_cells(n, t.medium.raw_size); }),
    choice_key(KeyKind::kText, "medium.N.density.endian", "\"little\"", "little|big", nullptr,
               "byte order of the raw file",
               [](const Node& n, KeyTarget t) { t.medium.raw_big_endian = n.text == "big"; }),
    plain_key(KeyKind::kText, "medium.N.density.grid", "",
              "the same as `grid` beside it: name of the grid in an OpenVDB or NanoVDB file",
              [](const Node& n, KeyTarget t) { t.medium.grid = n.text; }),
    choice_key(KeyKind::kText, "medium.N.format", "", "pbrt|raw|vol|les|openvdb|nanovdb", "netcdf",
               "kind of the file; left out: told by the end of its name",
               [](const Node& n, KeyTarget t) { t.medium.format = n.text; }),
    plain_key(
        KeyKind::kText, "medium.N.grid", "",
        "name of the grid in an OpenVDB or NanoVDB file; left out: the first of floats that is "
        "no level set",
        [](const Node& n, KeyTarget t) { t.medium.grid = n.text; }),
    range_key(KeyKind::kBounds, "medium.N.bounds_m", "m", "", {-1e9, 1e9, false, false},
              "lowest and highest corner of the medium's box; may be left out for files that know "
              "their place, and wins where given",
              [](const Node& n, KeyTarget t) {
                  t.medium.has_bounds = true;
                  t.medium.bounds_m = {number3_of(n.children[0]), number3_of(n.children[1])};
              }),
    range_key(KeyKind::kInteger3, "medium.N.resolution", "cells", "", kCells,
              "cells along x, y, z; procedural and uniform only; left out: a suitable number",
              [](const Node& n, KeyTarget t) { set_cells(n, t.medium.resolution); }),
    range_key(KeyKind::kInteger, "medium.N.shape_seed", "", "0", {0, 0x1p63, false, false},
              "another procedural cloud for each number",
              [](const Node& n, KeyTarget t) { t.medium.shape_seed = integer_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.extinction_per_m", "1/m", "", {0, 1e12, false, false},
              "extinction coefficient where the density is 1; required, but for files that hold "
              "extinction (les)",
              [](const Node& n, KeyTarget t) { t.medium.extinction_per_m = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.extinction_scale", "", "1", {0, 1e12, false, false},
              "factor on the values of a file that holds extinction in 1/m (les), for no others",
              [](const Node& n, KeyTarget t) { t.medium.extinction_scale = number_of(n); }),
    range_key(KeyKind::kColor, "medium.N.albedo", "", "1", kShare,
              "share of the extinction that scatters; the rest is absorbed",
              [](const Node& n, KeyTarget t) { t.medium.albedo = color_of(n); }),

    choice_key(KeyKind::kText, "medium.N.phase.type", kRequired, kPhases, nullptr,
               "phase function; a medium without `phase` scatters alike in all directions",
               [](const Node& n, KeyTarget t) { t.medium.phase.kind = phase_kind(n.text); }),
    range_key(KeyKind::kNumber, "medium.N.phase.g", "", "", kCosine,
              "mean cosine of henyey-greenstein, required there; 1 is straight on",
              [](const Node& n, KeyTarget t) { t.medium.phase.g = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.phase.g1", "", "", kCosine,
              "mean cosine of the first of two lobes, required there",
              [](const Node& n, KeyTarget t) { t.medium.phase.g1 = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.phase.g2", "", "", kCosine,
              "mean cosine of the second of two lobes, required there",
              [](const Node& n, KeyTarget t) { t.medium.phase.g2 = number_of(n); }),
    range_key(KeyKind::kNumber, "medium.N.phase.weight", "", "", kShare,
              "share of the first of two lobes, required there",
              [](const Node& n, KeyTarget t) { t.medium.phase.weight = number_of(n); }),
    range_key(
        KeyKind::kNumber, "medium.N.phase.droplet_diameter_um", "um", "", {5, 50, false, false},
        "diameter of the droplets of hg-draine, required there",
        [](const Node& n, KeyTarget t) { t.medium.phase.droplet_diameter_um = number_of(n); }),
    range_key(
        KeyKind::kNumber, "medium.N.phase.effective_radius_um", "um", "", {4, 20, false, false},
        "effective radius of the droplets of a cloud; this or `phase.cloud` is required there",
        [](const Node& n, KeyTarget t) { t.medium.phase.effective_radius_um = number_of(n); }),
    choice_key(KeyKind::kText, "medium.N.phase.cloud", "", kClouds, nullptr,
               "kind of cloud, which sets the effective radius (docs/phase.md)",
               [](const Node& n, KeyTarget t) {
                   t.medium.phase.effective_radius_um = cloud_radius(n.text);
               }),
    plain_key(KeyKind::kText, "medium.N.phase.file", "",
              "path of a table of angles and values, or of Legendre moments, relative to the scene "
              "file; required by both",
              nullptr),

    choice_key(KeyKind::kText, "medium.N.boundary", "\"open\"", "open|periodic", nullptr,
               "what lies beside the box: nothing, or the same again without end along x and y; "
               "periodic for all media of a scene, with one box in x and y, or for none",
               [](const Node& n, KeyTarget t) { t.medium.periodic = n.text == "periodic"; }),
    plain_key(KeyKind::kBool, "medium.N.y_up", "false",
              "true: the file's y axis points up; files only",
              [](const Node& n, KeyTarget t) { t.medium.y_up = n.flag; }),
};

}  // namespace

Span<const KeyRow> medium_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
